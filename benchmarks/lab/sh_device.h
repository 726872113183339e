#pragma once

#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "prelight/device.h"

namespace prelight::sh {

/// Returns values of all order^2 functions in unit directions, [i][direction], computed on a device in float.
/// At every order the error is about 1e-7 of the largest value of the function's band. Throws UsageError for
/// a bad order.
std::vector<float> evaluateOnDevice(const Device& device, std::span<const glm::vec3> directions, int order);

}  // namespace prelight::sh

namespace prelight::ch {

/// Evaluates CH on the device in the same way.
std::vector<float> evaluateOnDevice(const Device& device, std::span<const glm::vec3> directions, int order);

}  // namespace prelight::ch
