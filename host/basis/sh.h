#pragma once

#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "io/environment.h"

/// Real spherical harmonics in double precision: orthonormal, no Condon-Shortley phase, index l(l+1)+m,
/// functions of world (x, y, z) with polar axis z: Y_1 = sqrt(3/4pi) (y, z, x). Order n means bands 0..n-1.
namespace prelight::sh {

constexpr int maxOrder = 32;

constexpr int coefficientCount(int order) { return order * order; }

/// Values of all n^2 functions in a unit direction, by recurrence in l and Cartesian sectoral terms (no
/// trigonometry). `values` has order^2 entries.
void evaluate(const glm::dvec3& direction, int order, std::span<double> values);

/// Zonal coefficients of max(cos,0)/pi by band: the transfer of an unoccluded receiver with normal n is
/// T_lm = clampedCosine(l) Y_lm(n). (Ramamoorthi and Hanrahan 2001: A_l / pi.)
double clampedCosine(int band);

/// Transfer of an unoccluded receiver: T_i = clampedCosine(l) Y_i(normal).
void openTransfer(const glm::dvec3& normal, int order, std::span<double> values);

/// Projection of a sky whose radiance is constant over each texel: L_i = sum L(texel) integral_texel Y_i dw,
/// exact up to rounding however few texels there are. Returns [channel][i], 3 x order^2.
std::vector<double> projectEnvironment(const Environment& environment, int order);

/// Coefficients of the rotated function f'(w) = f(R^-1 w), for one channel of order^2 entries. Exact up to
/// rounding: a product quadrature integrates every product of two functions of that order without error.
std::vector<double> rotate(std::span<const double> coefficients, int order, const glm::dmat3& rotation);

}  // namespace prelight::sh
