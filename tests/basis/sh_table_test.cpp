#include "basis/sh_evaluate.h"

#include <gtest/gtest.h>

#include <numbers>
#include <vector>

namespace prelight {
namespace {

/// Values at z of the polynomials of degree l, [l], computed from an m's constants by their recurrence.
std::vector<double> polynomials(const std::vector<float>& table, std::size_t order, std::size_t m, double z) {
  std::vector<double> values(order, 0.0);
  values[m] = table[2 * m];
  for (std::size_t l = m + 1; l < order; ++l) {
    const std::size_t at = 2 * (order + l * order + m);
    values[l] = table[at] * z * values[l - 1] - (l > m + 1 ? table[at + 1] * values[l - 2] : 0.0);
  }
  return values;
}

// Harmonics are orthonormal over the sphere, so polynomials of one m are orthonormal under the weight (1 -
// z^2)^m times the integral of cos^2(m phi). Integrals use the midpoint rule.
TEST(ShTable, Recurrence_MakesOrthonormalFunctions) {
  constexpr std::size_t order = 9;
  constexpr int steps = 20000;
  const std::vector<float> table = makeShTable(static_cast<int>(order));
  for (std::size_t m = 0; m < order; ++m) {
    std::vector<double> products(order * order, 0.0);
    for (int i = 0; i < steps; ++i) {
      const double z = -1.0 + (2.0 * i + 1.0) / steps;
      double weight = (m == 0 ? 2.0 : 1.0) * std::numbers::pi * 2.0 / steps;
      for (std::size_t k = 0; k < m; ++k) weight *= 1.0 - z * z;
      const std::vector<double> values = polynomials(table, order, m, z);
      for (std::size_t a = m; a < order; ++a)
        for (std::size_t b = m; b < order; ++b) products[a * order + b] += weight * values[a] * values[b];
    }
    for (std::size_t a = m; a < order; ++a)
      for (std::size_t b = m; b < order; ++b)
        EXPECT_NEAR(products[a * order + b], a == b ? 1.0 : 0.0, 2e-6)
            << "l " << a << ", " << b << ", m " << m;
  }
}

}  // namespace
}  // namespace prelight
