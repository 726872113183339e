#include "basis/quadrature.h"

#include <cassert>
#include <cmath>
#include <numbers>

namespace prelight {
namespace {

struct Legendre {
  double value = 0.0;
  double derivative = 0.0;
};

/// Returns P_n and its derivative inside (-1, 1), by Bonnet's recurrence.
Legendre legendre(int n, double x) {
  double before = 0.0;
  double p = 1.0;
  for (int l = 1; l <= n; ++l) {
    const double next = ((2.0 * l - 1.0) * x * p - (l - 1.0) * before) / l;
    before = p;
    p = next;
  }
  return {p, n * (x * p - before) / (x * x - 1.0)};
}

}  // namespace

std::vector<LineSample> gaussLegendre(int count) {
  assert(count >= 1);
  std::vector<LineSample> samples(count);
  for (int i = 0; i < count; ++i) {
    // Newton from Chebyshev's estimate of the root converges quadratically; six steps are more than double
    // needs.
    double x = -std::cos(std::numbers::pi * (i + 0.75) / (count + 0.5));
    for (int step = 0; step < 6; ++step) {
      const Legendre p = legendre(count, x);
      x -= p.value / p.derivative;
    }
    const double slope = legendre(count, x).derivative;
    samples[i] = {x, 2.0 / ((1.0 - x * x) * slope * slope)};
  }
  return samples;
}

std::vector<SphereSample> sphereQuadrature(int degree) {
  assert(degree >= 0);
  const int columns = degree + 1;
  std::vector<SphereSample> samples;
  for (const LineSample& row : gaussLegendre(degree / 2 + 1)) {
    const double radius = std::sqrt(1.0 - row.position * row.position);
    for (int i = 0; i < columns; ++i) {
      const double phi = 2.0 * std::numbers::pi * i / columns;
      samples.push_back({{radius * std::cos(phi), radius * std::sin(phi), row.position},
                         row.weight * 2.0 * std::numbers::pi / columns});
    }
  }
  return samples;
}

}  // namespace prelight
