#include "basis/sh_zonal.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <glm/glm.hpp>
#include <numbers>
#include <string>
#include <utility>

#include "basis/quadrature.h"
#include "basis/sh_evaluate.h"
#include "prelight/error.h"

// [1] Ramamoorthi and Hanrahan, "An efficient representation for irradiance environment maps", 2001.
// [2] Sloan, "Stupid spherical harmonics (SH) tricks", 2008: windows, and smoothing that penalises
//     the squared Laplacian, which gives the factors 1 / (1 + lambda l^2 (l + 1)^2).
// [3] Sloan, "Deringing spherical harmonics", 2017: the least lambda without negative values.

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

double legendreSum(std::span<const double> factors, double cosine) {
  double before = 0.0, legendre = 1.0, sum = 0.0;
  for (std::size_t band = 0; band < factors.size(); ++band) {
    const auto l = static_cast<double>(band);
    sum += factors[band] * legendre;
    before = std::exchange(legendre, ((2.0 * l + 1.0) * cosine * legendre - l * before) / (l + 1.0));
  }
  return sum;
}

double openTowards(double cosine, int order) {
  std::array<double, maxOrder> factors;
  for (int l = 0; l < order; ++l) factors[static_cast<std::size_t>(l)] = clampedCosine(l) * (2 * l + 1);
  return legendreSum(std::span(factors).first(static_cast<std::size_t>(order)), cosine) /
         (4.0 * std::numbers::pi);
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

namespace {

std::vector<double> laplacianFactors(double lambda, int order) {
  std::vector<double> factors(order);
  for (int l = 0; l < order; ++l) {
    const double eigenvalue = l * (l + 1.0);
    factors[l] = 1.0 / (1.0 + lambda * eigenvalue * eigenvalue);
  }
  return factors;
}

/// Finds minima of functions; stores the functions' values on a grid fine enough to come near every minimum.
class MinimumSearch {
 public:
  explicit MinimumSearch(int order) : order_(order), count_(coefficientCount(order)) {
    for (const SphereSample& s : sphereQuadrature(3 * order)) {
      directions_.push_back(s.direction);
      values_.resize(values_.size() + count_);
      evaluate(s.direction, order, std::span(values_).last(count_));
    }
  }

  double operator()(std::span<const double> f) const {
    std::vector<std::pair<double, std::size_t>> found;
    for (std::size_t d = 0; d < directions_.size(); ++d) {
      double sum = 0.0;
      for (std::size_t i = 0; i < count_; ++i) sum += f[i] * values_[d * count_ + i];
      found.emplace_back(sum, d);
    }
    const std::size_t starts = std::min<std::size_t>(8, found.size());
    std::partial_sort(found.begin(), found.begin() + static_cast<std::ptrdiff_t>(starts), found.end());
    double least = found.front().first;
    for (std::size_t i = 0; i < starts; ++i)
      least = std::min(least, descend(f, directions_[found[i].second]));
    return least;
  }

 private:
  double slope(std::span<const double> f, const glm::dvec3& w, const glm::dvec3& tangent) const {
    std::vector<double> values(count_);
    evaluateDerivative(w, tangent, order_, values);
    double sum = 0.0;
    for (std::size_t i = 0; i < count_; ++i) sum += f[i] * values[i];
    return sum;
  }

  /// Descends along the negative gradient. The step is halved when it does not help and grows when it does.
  double descend(std::span<const double> f, glm::dvec3 w) const {
    double value = reconstruct(f, order_, w);
    double step = 0.25 / order_;  // radians; the grid is finer than 2 / order
    for (int i = 0; i < 100 && step > 1e-9; ++i) {
      const glm::dvec3 other = std::abs(w.x) < 0.6 ? glm::dvec3(1.0, 0.0, 0.0) : glm::dvec3(0.0, 1.0, 0.0);
      const glm::dvec3 right = glm::normalize(glm::cross(other, w));
      const glm::dvec3 up = glm::cross(w, right);
      const glm::dvec3 gradient = slope(f, w, right) * right + slope(f, w, up) * up;
      const double length = glm::length(gradient);
      if (length == 0.0) break;
      const glm::dvec3 next = glm::normalize(w - step / length * gradient);
      const double nextValue = reconstruct(f, order_, next);
      if (nextValue < value) {
        w = next;
        value = nextValue;
        step *= 1.3;
      } else {
        step *= 0.5;
      }
    }
    return value;
  }

  int order_;
  std::size_t count_;
  std::vector<glm::dvec3> directions_;
  std::vector<double> values_;  ///< [direction][i]
};

/// Returns true when all of the smoothed functions are >= 0.
bool nowhereNegative(const MinimumSearch& search, std::span<const double> coefficients, int order,
                     double lambda) {
  const std::vector<double> factors = laplacianFactors(lambda, order);
  const std::size_t count = coefficientCount(order);
  for (std::size_t function = 0; function < coefficients.size(); function += count) {
    std::vector<double> smooth(coefficients.begin() + static_cast<std::ptrdiff_t>(function),
                               coefficients.begin() + static_cast<std::ptrdiff_t>(function + count));
    applyWindow(smooth, factors);
    const double mean = smooth[0] * 0.5 * std::sqrt(std::numbers::inv_pi);
    if (search(smooth) < -1e-9 * mean) return false;
  }
  return true;
}

void checkMeans(std::span<const double> coefficients, int order) {
  const std::size_t count = coefficientCount(order);
  for (std::size_t function = 0; function < coefficients.size(); function += count) {
    const auto f = coefficients.subspan(function, count);
    const bool isZero = std::all_of(f.begin(), f.end(), [](double v) { return v == 0.0; });
    if (f[0] > 0.0 || isZero) continue;
    throw UsageError("window", "function " + std::to_string(function / count) +
                                   " is not positive in the mean (its first coefficient is " +
                                   std::to_string(f[0]) + "): no window makes it so");
  }
}

}  // namespace

std::vector<double> window(WindowKind kind, int order) {
  checkOrder(order, "window");
  std::vector<double> factors(order, 1.0);
  for (int l = 1; l < order; ++l) {
    const double x = std::numbers::pi * l / order;
    if (kind == WindowKind::Hanning) factors[l] = 0.5 * (1.0 + std::cos(x));
    if (kind == WindowKind::Lanczos) factors[l] = std::sin(x) / x;
  }
  return factors;
}

void applyWindow(std::span<double> coefficients, std::span<const double> factors) {
  const std::size_t count = factors.size() * factors.size();
  assert(count > 0 && coefficients.size() % count == 0);
  for (std::size_t function = 0; function < coefficients.size(); function += count) {
    for (std::size_t l = 0; l < factors.size(); ++l) {
      for (std::size_t i = l * l; i < (l + 1) * (l + 1); ++i) coefficients[function + i] *= factors[l];
    }
  }
}

double minimum(std::span<const double> coefficients, int order) {
  checkOrder(order, "minimum");
  checkCoefficients(coefficients, coefficientCount(order), "minimum");
  return MinimumSearch(order)(coefficients);
}

MinimalWindow minimalWindow(std::span<const double> coefficients, int order, double precision) {
  checkOrder(order, "window");
  const std::size_t count = coefficientCount(order);
  checkCoefficients(coefficients, std::max<std::size_t>(1, coefficients.size() / count) * count, "window");
  checkMeans(coefficients, order);
  const MinimumSearch search(order);
  if (nowhereNegative(search, coefficients, order, 0.0)) return {0.0, laplacianFactors(0.0, order)};
  double high = 1e-6;
  while (!nowhereNegative(search, coefficients, order, high)) high *= 4.0;
  double low = 0.0;
  for (int step = 0; step < 40 && high - low > precision * high; ++step) {
    const double middle = 0.5 * (low + high);
    (nowhereNegative(search, coefficients, order, middle) ? high : low) = middle;
  }
  return {high, laplacianFactors(high, order)};
}

}  // namespace prelight::sh
