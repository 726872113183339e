#pragma once

#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "prelight/device.h"

namespace prelight::sh {

/// Values of all order^2 functions in unit directions, computed on a device in float: [i][direction]. Off by
/// about 1e-7 of the largest value of each function's band at every order. Throws UsageError for a bad order.
std::vector<float> evaluateOnDevice(const Device& device, std::span<const glm::vec3> directions, int order);

}  // namespace prelight::sh

namespace prelight::ch {

/// Evaluates CH on the device in the same way.
std::vector<float> evaluateOnDevice(const Device& device, std::span<const glm::vec3> directions, int order);

}  // namespace prelight::ch
