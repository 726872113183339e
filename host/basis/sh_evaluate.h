#pragma once

#include <glm/glm.hpp>
#include <span>
#include <vector>

/// Real spherical harmonics in double precision: orthonormal, no Condon-Shortley phase, index l(l+1)+m,
/// functions of world (x, y, z) with polar axis z: Y_1 = sqrt(3/4pi) (y, z, x). Order n means bands 0..n-1.

namespace prelight::sh {

constexpr int maxOrder = 32;

constexpr int coefficientCount(int order) { return order * order; }

/// Throws UsageError unless 1 <= order <= maxOrder; `where` names the caller's option or argument.
void checkOrder(int order, const char* where);

/// Throws UsageError unless there are `expected` values and all are finite.
void checkCoefficients(std::span<const double> coefficients, std::size_t expected, const char* where);

/// Writes the values of all n^2 functions in a unit direction, by recurrence in l and Cartesian sectoral
/// terms (no trigonometry). `values` has order^2 entries. Throws UsageError for a bad order, as the other
/// functions here do.
void evaluate(const glm::dvec3& direction, int order, std::span<double> values);

/// Writes the derivatives of all n^2 functions along `tangent`, a vector perpendicular to the unit
/// `direction`: per radian, times the tangent's length. `values` has order^2 entries.
void evaluateDerivative(const glm::dvec3& direction, const glm::dvec3& tangent, int order,
                        std::span<double> values);

/// Returns the value in a direction of the function that order^2 coefficients represent.
double reconstruct(std::span<const double> coefficients, int order, const glm::dvec3& direction);

}  // namespace prelight::sh

namespace prelight {

/// Returns the constants of kernels/project/sh_funcs.cl for an order, computed in double precision and
/// rounded once: [2 m] sectoral factors K_m, then [2 (n + l n + m)] and [.. + 1] the recurrence's a_lm and
/// c_lm.
std::vector<float> makeShTable(int order);

}  // namespace prelight
