#include "basis/sh_dominant_light.h"

#include <algorithm>

#include "basis/sh_evaluate.h"
#include "prelight/error.h"

// [1] Sloan, "Stupid spherical harmonics (SH) tricks", 2008, "Extracting dominant light".

namespace prelight::sh {
namespace {

/// Luminance of linear RGB with Rec. 709 primaries.
constexpr double luminanceWeights[3] = {0.2126, 0.7152, 0.0722};

}  // namespace

std::optional<DominantLight> dominantLight(std::span<const double> radiance, int order) {
  checkOrder(order, "dominant light");
  if (order < 2) throw UsageError("dominant light", "expected an order of at least 2, got 1");
  const std::size_t count = coefficientCount(order);
  checkCoefficients(radiance, 3 * count, "dominant light");
  glm::dvec3 linear(0.0);
  for (int c = 0; c < 3; ++c) {
    const auto channel = radiance.subspan(c * count, count);
    linear += luminanceWeights[c] * glm::dvec3(channel[3], channel[1], channel[2]);  // Y_1 = (y, z, x)
  }
  const double length = glm::length(linear);
  if (length == 0.0) return std::nullopt;
  DominantLight light{linear / length, glm::dvec3(0.0), {radiance.begin(), radiance.end()}};
  std::vector<double> basis(count);
  evaluate(light.towards, order, basis);
  double square = 0.0;
  for (const double v : basis) square += v * v;
  for (int c = 0; c < 3; ++c) {
    double product = 0.0;
    for (std::size_t i = 0; i < count; ++i) product += basis[i] * radiance[c * count + i];
    light.irradiance[c] = std::max(0.0, product / square);
    for (std::size_t i = 0; i < count; ++i) light.residual[c * count + i] -= light.irradiance[c] * basis[i];
  }
  return light;
}

}  // namespace prelight::sh
