#include "basis/sh_evaluate.h"

#include <array>
#include <cassert>
#include <cmath>
#include <numbers>
#include <string>

#include "prelight/error.h"

// [1] Press et al., "Numerical recipes", 3rd ed., 6.7: the normalised Legendre recurrence in l.
// [2] Sloan, "Efficient spherical harmonic evaluation", 2013: sectoral terms as Re and Im of (x + iy)^m.

namespace prelight::sh {

namespace {

/// Factors of the recurrence [1] P(l) = a(l,m) (z P(l-1) - b(l,m) P(l-2)) of the functions divided by sin^m.
struct Recurrence {
  std::array<std::array<double, maxOrder>, maxOrder> a{};
  std::array<std::array<double, maxOrder>, maxOrder> b{};
  std::array<double, maxOrder> sectoral{};  ///< P(m,m), including sqrt(2) for m > 0

  Recurrence() {
    double pmm = std::sqrt(0.25 * std::numbers::inv_pi);  // Y_00 = 1 / sqrt(4 pi)
    for (int m = 0; m < maxOrder; ++m) {
      if (m > 0) pmm *= std::sqrt((2.0 * m + 1.0) / (2.0 * m));
      sectoral[m] = m > 0 ? std::numbers::sqrt2 * pmm : pmm;
      for (int l = m + 1; l < maxOrder; ++l) {
        const double l2 = static_cast<double>(l) * l;
        const double m2 = static_cast<double>(m) * m;
        const double previous = (l - 1.0) * (l - 1.0);
        a[l][m] = std::sqrt((4.0 * l2 - 1.0) / (l2 - m2));
        b[l][m] = l > 1 ? std::sqrt((previous - m2) / (4.0 * previous - 1.0)) : 0.0;
      }
    }
  }
};

const Recurrence& recurrence() {
  static const Recurrence table;
  return table;
}

}  // namespace

void checkOrder(int order, const char* where) {
  if (order >= 1 && order <= maxOrder) return;
  throw UsageError(
      where, "expected an order from 1 to " + std::to_string(maxOrder) + ", got " + std::to_string(order));
}

void checkCoefficients(std::span<const double> coefficients, std::size_t expected, const char* where) {
  if (coefficients.size() != expected) {
    throw UsageError(where, "expected " + std::to_string(expected) + " coefficients, got " +
                                std::to_string(coefficients.size()));
  }
  for (std::size_t i = 0; i < expected; ++i) {
    if (std::isfinite(coefficients[i])) continue;
    throw UsageError(where, "coefficient " + std::to_string(i) + " is not finite (" +
                                std::to_string(coefficients[i]) + ")");
  }
}

void evaluate(const glm::dvec3& direction, int order, std::span<double> values) {
  checkOrder(order, "spherical harmonics");
  assert(values.size() >= static_cast<std::size_t>(coefficientCount(order)));
  const Recurrence& table = recurrence();
  double real = 1.0;  // real part of (x + iy)^m [2]
  double imaginary = 0.0;
  for (int m = 0; m < order; ++m) {
    if (m > 0) {
      const double next = real * direction.x - imaginary * direction.y;
      imaginary = imaginary * direction.x + real * direction.y;
      real = next;
    }
    double before = 0.0;
    double p = table.sectoral[m];
    for (int l = m; l < order; ++l) {
      if (l > m) {
        const double next = table.a[l][m] * (direction.z * p - table.b[l][m] * before);
        before = p;
        p = next;
      }
      values[l * (l + 1) + m] = p * real;
      if (m > 0) values[l * (l + 1) - m] = p * imaginary;
    }
  }
}

void evaluateDerivative(const glm::dvec3& direction, const glm::dvec3& tangent, int order,
                        std::span<double> values) {
  checkOrder(order, "spherical harmonics");
  assert(values.size() >= static_cast<std::size_t>(coefficientCount(order)));
  const Recurrence& table = recurrence();
  double real = 1.0;
  double imaginary = 0.0;
  double realSlope = 0.0;  // d (x + iy)^m = m (x + iy)^(m-1) (dx + i dy)
  double imaginarySlope = 0.0;
  for (int m = 0; m < order; ++m) {
    if (m > 0) {
      realSlope = m * (real * tangent.x - imaginary * tangent.y);
      imaginarySlope = m * (imaginary * tangent.x + real * tangent.y);
      const double next = real * direction.x - imaginary * direction.y;
      imaginary = imaginary * direction.x + real * direction.y;
      real = next;
    }
    double before = 0.0;
    double slopeBefore = 0.0;
    double p = table.sectoral[m];
    double slope = 0.0;
    for (int l = m; l < order; ++l) {
      if (l > m) {
        const double a = table.a[l][m];
        const double b = table.b[l][m];
        const double slopeNext = a * (tangent.z * p + direction.z * slope - b * slopeBefore);
        const double next = a * (direction.z * p - b * before);
        before = p;
        p = next;
        slopeBefore = slope;
        slope = slopeNext;
      }
      values[l * (l + 1) + m] = slope * real + p * realSlope;
      if (m > 0) values[l * (l + 1) - m] = slope * imaginary + p * imaginarySlope;
    }
  }
}

double reconstruct(std::span<const double> coefficients, int order, const glm::dvec3& direction) {
  checkOrder(order, "spherical harmonics");
  assert(coefficients.size() >= static_cast<std::size_t>(coefficientCount(order)));
  std::array<double, coefficientCount(maxOrder)> values;
  evaluate(direction, order, values);
  double sum = 0.0;
  for (int i = 0; i < coefficientCount(order); ++i) sum += coefficients[i] * values[i];
  return sum;
}

}  // namespace prelight::sh

namespace prelight {

std::vector<float> makeShTable(int order) {
  const auto n = static_cast<std::size_t>(order);
  std::vector<float> table(2 * (n + n * n) + 2, 0.0f);
  double sectoral = std::sqrt(0.25 / std::numbers::pi);
  for (std::size_t m = 0; m < n; ++m) {
    const double dm = static_cast<double>(m);
    // K_m = K_(m-1) sqrt((2m + 1) / 2m); m > 0 also carries sqrt(2), the norm of cos(m phi).
    if (m > 0) sectoral *= std::sqrt((2.0 * dm + 1.0) / (2.0 * dm)) * (m == 1 ? std::numbers::sqrt2 : 1.0);
    table[2 * m] = static_cast<float>(sectoral);
    for (std::size_t l = m + 1; l < n; ++l) {
      const double dl = static_cast<double>(l);
      const double a = std::sqrt((4.0 * dl * dl - 1.0) / (dl * dl - dm * dm));
      const double b = std::sqrt(((dl - 1.0) * (dl - 1.0) - dm * dm) / (4.0 * (dl - 1.0) * (dl - 1.0) - 1.0));
      table[2 * (n + l * n + m)] = static_cast<float>(a);
      table[2 * (n + l * n + m) + 1] = static_cast<float>(l > m + 1 ? a * b : 0.0);
    }
  }
  return table;
}

}  // namespace prelight
