#pragma once

#include <glm/glm.hpp>

#include "prelight/picture.h"

/// Comparing pictures and their pixels.
namespace prelight::test {

/// Expects every channel within `tolerance` times its value, of values below 1e-3 within `tolerance` x 1e-3.
void expectColor(const glm::vec3& got, const glm::dvec3& expected, double tolerance);

/// The greatest channel of any pixel.
double largest(const Picture& picture);

/// The greatest difference of a channel between pictures of one size.
double largestDifference(const Picture& a, const Picture& b);

}  // namespace prelight::test
