#pragma once

#include <fmt/format.h>

#include <cmath>
#include <glm/glm.hpp>

#include "prelight/error.h"

namespace prelight {

/// Returns a vector at length 1. Throws UsageError at `where` if it has no direction; `what` names it.
inline glm::dvec3 unitDirection(const glm::dvec3& vector, const char* where, const char* what = "direction") {
  const double length = glm::length(vector);
  if (!(length > 0.0) || !std::isfinite(length))
    throw UsageError(where, fmt::format("got the {} ({}, {}, {}), expected finite numbers, not all 0", what,
                                        vector.x, vector.y, vector.z));
  return vector / length;
}

}  // namespace prelight
