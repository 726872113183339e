#pragma once

#include <glm/glm.hpp>

#include "prelight/picture.h"

/// Comparing pictures and their pixels.
namespace prelight::test {

/// Expects every channel to differ by at most `tolerance` times its value, or times 1e-3 for smaller values.
void expectColor(const glm::vec3& got, const glm::dvec3& expected, double tolerance);

/// The greatest channel of all pixels.
double largest(const Picture& picture);

/// The greatest difference in any channel between two pictures of the same size.
double largestDifference(const Picture& a, const Picture& b);

}  // namespace prelight::test
