#pragma once

#include "device/context.h"

namespace prelight {

/// Bands of SH in which kernels/project/incident_funcs.cl computes incident radiance: 2, the default, to 5.
constexpr int leastIncidentOrder = 2, mostIncidentOrder = 5;

/// Returns the number of values per channel of a place: irradiance, and incident radiance in SH of an order.
constexpr int incidentValueCount(int order) { return 1 + order * order; }

/// Returns the order for a number of values; 0 for irradiance alone.
constexpr int incidentOrderOf(int values) {
  int order = 0;
  while (incidentValueCount(order + 1) <= values) ++order;
  return order;
}

/// Defines the order for programs that include project/incident_funcs.cl.
inline void addIncidentOrder(BuildOptions& options, int order) {
  if (order > leastIncidentOrder) options.define("PRELIGHT_INCIDENT_ORDER", order);
}

}  // namespace prelight
