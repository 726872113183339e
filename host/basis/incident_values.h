#pragma once

#include "device/build_options.h"

namespace prelight {

/// Bands of SH in which kernels/project/incident_funcs.cl tells incident radiance: from 2, by default, to 5.
constexpr int leastIncidentOrder = 2, mostIncidentOrder = 5;

/// Numbers a channel that it tells of a place: irradiance, and incident radiance in SH of an order.
constexpr int incidentValueCount(int order) { return 1 + order * order; }

/// The order of that many numbers; 0 of irradiance alone.
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
