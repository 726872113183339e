#pragma once

#include <glm/glm.hpp>
#include <span>
#include <vector>

namespace prelight::sh {

/// Coefficients of the rotated function f'(w) = f(R^-1 w), for one channel of order^2 entries. Exact up to
/// rounding: a product quadrature integrates every product of two functions of that order without error.
std::vector<double> rotate(std::span<const double> coefficients, int order, const glm::dmat3& rotation);

}  // namespace prelight::sh
