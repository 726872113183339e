#include "benchmarks/suites/indirect/mirrored_cylinder.h"

#include <cmath>
#include <numbers>

#include "benchmarks/suites/indirect/photon_samples.h"

namespace prelight::benchmarks {

namespace {

using std::numbers::pi;
constexpr double radius = 0.5;  // m

/// 0 where the light reflected at angle `a` passes over (x, z) of the unit circle.
double missing(double a, double x, double z) {
  return -x * std::sin(2.0 * a) + z * std::cos(2.0 * a) + std::sin(a);
}

/// Angle at which `missing` is 0 between two of different signs.
double hitBetween(double low, double high, double x, double z) {
  const bool rising = missing(low, x, z) < 0.0;
  for (int step = 0; step < 50; ++step) {
    const double middle = 0.5 * (low + high);
    ((missing(middle, x, z) < 0.0) == rising ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

}  // namespace

std::vector<device::Photon> MirroredCylinder::photons(std::size_t count, std::mt19937& random) {
  std::uniform_real_distribution<double> unit;
  std::vector<device::Photon> photons;
  while (photons.size() < count) {
    const double a = pi * (unit(random) - 0.5), cosine = std::cos(a);
    if (unit(random) >= cosine * cosine) continue;
    const double s = 2.0 * cosine * unit(random);
    const double x = 0.5 + radius * (cosine - s * std::cos(2.0 * a));
    const double z = 0.5 + radius * (std::sin(a) - s * std::sin(2.0 * a));
    photons.push_back(makePhoton({x, 0.0, z}, z > x ? 0 : 1, 1.0 / static_cast<double>(count)));
  }
  return photons;
}

double MirroredCylinder::irradiance(double x, double z) {
  const double u = (x - 0.5) / radius, v = (z - 0.5) / radius;
  if (u * u + v * v >= 1.0) return 0.0;
  constexpr int steps = 256;
  double sum = 0.0, before = missing(-0.5 * pi, u, v);
  for (int i = 1; i <= steps; ++i) {
    const double low = pi * (static_cast<double>(i - 1) / steps - 0.5),
                 high = pi * (static_cast<double>(i) / steps - 0.5);
    const double after = missing(high, u, v);
    if ((before < 0.0) != (after < 0.0)) {
      const double a = hitBetween(low, high, u, v);
      const double s = (std::cos(a) - u) * std::cos(2.0 * a) + (std::sin(a) - v) * std::sin(2.0 * a);
      if (s >= 0.0) sum += std::cos(a) / (pi * std::abs(std::cos(a) - 2.0 * s));
    }
    before = after;
  }
  return sum / (radius * radius);
}

}  // namespace prelight::benchmarks
