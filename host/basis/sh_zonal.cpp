#include "basis/sh_zonal.h"

#include <array>
#include <cassert>
#include <cmath>
#include <numbers>
#include <string>

#include "basis/sh_evaluate.h"
#include "prelight/error.h"

// [1] Ramamoorthi and Hanrahan, "An efficient representation for irradiance environment maps", 2001.

namespace prelight::sh {
namespace {

/// Multiplies every band of one or several functions of order^2 coefficients by its factor.
template <typename Factor>
void scaleBands(std::span<double> coefficients, int order, Factor factor) {
  const std::size_t count = coefficientCount(order);
  assert(coefficients.size() % count == 0);
  for (int l = 0; l < order; ++l) {
    const double f = factor(l);
    for (std::size_t function = 0; function < coefficients.size(); function += count) {
      for (int i = l * l; i < (l + 1) * (l + 1); ++i) coefficients[function + i] *= f;
    }
  }
}

/// Returns Y_l0 at the pole.
double poleValue(int l) { return std::sqrt((2.0 * l + 1.0) * 0.25 * std::numbers::inv_pi); }

}  // namespace

double clampedCosine(int band) {
  assert(band >= 0);
  if (band == 1) return 2.0 / 3.0;
  if (band % 2 == 1) return 0.0;
  // [1] Eq. 8, divided by pi: A_0 = 1, and A_l = -A_(l-2) (l-3)/(l+2) for even l, from the ratio of its
  // factorials.
  double value = 1.0;
  for (int l = 2; l <= band; l += 2) value *= -(l - 3.0) / (l + 2.0);
  return value;
}

void openTransfer(const glm::dvec3& normal, int order, std::span<double> values) {
  evaluate(normal, order, values);
  scaleBands(values.first(coefficientCount(order)), order, clampedCosine);
}

void capZonal(double halfAngle, std::span<double> zonal) {
  if (!(halfAngle >= 0.0 && halfAngle <= std::numbers::pi)) {
    throw UsageError("cap light",
                     "expected a half angle from 0 to pi radians, got " + std::to_string(halfAngle));
  }
  // integral_c^1 P_l = (1 - c^2) P_l'(c) / (l (l + 1)), from Legendre's equation: unlike P_(l-1) - P_(l+1) it
  // does not cancel. P_l' is the Gegenbauer polynomial C_(l-1)^(3/2).
  const double c = std::cos(halfAngle);
  const double s = std::sin(halfAngle);
  double before = 0.0;
  double slope = 1.0;
  for (std::size_t band = 0; band < zonal.size(); ++band) {
    const auto l = static_cast<double>(band);
    const double factor = 2.0 * std::numbers::pi * poleValue(static_cast<int>(band));
    if (band == 0) {
      const double half = std::sin(0.5 * halfAngle);
      zonal[band] = factor * 2.0 * half * half;
      continue;
    }
    if (band > 1) {
      const double next = ((2.0 * l - 1.0) * c * slope - l * before) / (l - 1.0);
      before = slope;
      slope = next;
    }
    zonal[band] = factor * s * s * slope / (l * (l + 1.0));
  }
}

void cosinePowerZonal(double exponent, std::span<double> zonal) {
  if (!(exponent >= 0.0 && std::isfinite(exponent))) {
    throw UsageError("cosine power lobe", "expected an exponent >= 0, got " + std::to_string(exponent));
  }
  // I_l = integral_0^1 x^s P_l dx: I_l = I_(l-2) (s - l + 2) / (s + l + 1), with I_0 = 1 / (s + 1) and
  // I_1 = 1 / (s + 2).
  std::array<double, 2> integral = {
      1.0, (exponent + 1.0) / (exponent + 2.0)};  // for even and odd bands, times s + 1
  for (std::size_t band = 0; band < zonal.size(); ++band) {
    const auto l = static_cast<double>(band);
    double& value = integral[band % 2];
    if (band > 1) value *= (exponent - l + 2.0) / (exponent + l + 1.0);
    zonal[band] = value * poleValue(static_cast<int>(band));
  }
}

void turnZonal(std::span<const double> zonal, const glm::dvec3& axis, std::span<double> values) {
  const int order = static_cast<int>(zonal.size());
  assert(values.size() == zonal.size() * zonal.size());
  evaluate(axis, order, values);
  scaleBands(values, order, [&](int l) { return zonal[l] / poleValue(l); });
}

void convolve(std::span<double> coefficients, std::span<const double> zonal) {
  scaleBands(coefficients, static_cast<int>(zonal.size()), [&](int l) { return zonal[l] / poleValue(l); });
}

void irradianceFromRadiance(std::span<double> coefficients, int order) {
  scaleBands(coefficients, order, [](int l) { return std::numbers::pi * clampedCosine(l); });
}

}  // namespace prelight::sh
