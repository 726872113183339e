#include "basis/lights/sh_dominant_light.h"

#include <algorithm>
#include <cmath>

#include "base/directions.h"
#include "basis/sh_evaluate.h"
#include "prelight/error.h"

// [1] Sloan, "Stupid spherical harmonics (SH) tricks", 2008, "Extracting dominant light".

namespace prelight::sh {
namespace {

/// Weights of luminance for linear RGB with Rec. 709 primaries.
constexpr double luminanceWeights[3] = {0.2126, 0.7152, 0.0722};

constexpr double firstStep = 0.2, lastStep = 1e-7;  // rad

void checkRadiance(std::span<const double> radiance, int order) {
  checkOrder(order, "dominant light");
  if (order < 2) throw UsageError("dominant light", "expected an order of at least 2, got 1");
  checkCoefficients(radiance, static_cast<std::size_t>(3 * coefficientCount(order)), "dominant light");
}

std::vector<double> luminanceOf(std::span<const double> radiance, int order) {
  const auto count = static_cast<std::size_t>(coefficientCount(order));
  std::vector<double> sum(count, 0.0);
  for (std::size_t c = 0; c < 3; ++c)
    for (std::size_t i = 0; i < count; ++i) sum[i] += luminanceWeights[c] * radiance[c * count + i];
  return sum;
}

std::vector<double> valuesIn(const glm::dvec3& direction, int order) {
  std::vector<double> values(static_cast<std::size_t>(coefficientCount(order)));
  evaluate(direction, order, values);
  return values;
}

double product(std::span<const double> a, std::span<const double> b) {
  double sum = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += a[i] * b[i];
  return sum;
}

/// Returns the direction near `start` in which a light reduces the squared residual most. All lights of
/// irradiance 1 have the same norm, so that this is a maximum of the function. The search uses ever smaller
/// steps.
glm::dvec3 climb(std::span<const double> function, int order, glm::dvec3 start) {
  double best = reconstruct(function, order, start);
  for (double step = firstStep; step > lastStep;) {
    const glm::dvec3 helper = std::abs(start.z) < 0.9 ? glm::dvec3(0, 0, 1) : glm::dvec3(1, 0, 0);
    const glm::dvec3 side = glm::normalize(glm::cross(helper, start)), up = glm::cross(start, side);
    const glm::dvec3 centre = start;
    for (const glm::dvec3& way : {side, -side, up, -up}) {
      const glm::dvec3 there = glm::normalize(centre + step * way);
      const double value = reconstruct(function, order, there);
      if (value > best) {
        best = value;
        start = there;
      }
    }
    if (start == centre) step *= 0.5;
  }
  return start;
}

/// Returns the direction, over the whole sphere, in which a light reduces the squared residual most. Climbs
/// from the best of evenly distributed directions, several of which lie on each peak of the highest band.
glm::dvec3 highest(std::span<const double> function, int order) {
  glm::dvec3 best(0.0, 0.0, 1.0);
  double greatest = reconstruct(function, order, best);
  for (const glm::dvec3& direction : spiralDirections(16 * order * order)) {
    const double value = reconstruct(function, order, direction);
    if (value > greatest) {
      greatest = value;
      best = direction;
    }
  }
  return climb(function, order, best);
}

/// Returns the intensities >= 0 of least squared residual, by optimising one after the other repeatedly,
/// which converges to the minimum of a convex function.
std::vector<double> intensities(std::span<const double> function,
                                const std::vector<std::vector<double>>& lights) {
  constexpr int mostRounds = 2000;
  std::vector<double> found(lights.size(), 0.0);
  std::vector<double> rest(function.begin(), function.end());
  for (int round = 0; round < mostRounds; ++round) {
    double change = 0.0, size = 0.0;
    for (std::size_t k = 0; k < lights.size(); ++k) {
      const double own = product(lights[k], lights[k]);
      const double next = std::max(0.0, found[k] + product(rest, lights[k]) / own);
      for (std::size_t i = 0; i < rest.size(); ++i) rest[i] -= (next - found[k]) * lights[k][i];
      change = std::max(change, std::abs(next - found[k]));
      size = std::max(size, next);
      found[k] = next;
    }
    if (change <= 1e-15 * size) break;
  }
  return found;
}

std::vector<double> without(std::span<const double> function, const std::vector<std::vector<double>>& lights,
                            const std::vector<double>& scales) {
  std::vector<double> rest(function.begin(), function.end());
  for (std::size_t k = 0; k < lights.size(); ++k)
    for (std::size_t i = 0; i < rest.size(); ++i) rest[i] -= scales[k] * lights[k][i];
  return rest;
}

/// Turns each light in turn to the direction in which it most reduces the residual that the other lights
/// leave.
void turnLights(std::span<const double> function, int order, std::vector<glm::dvec3>& directions,
                std::vector<std::vector<double>>& lights) {
  constexpr int rounds = 20;
  for (int round = 0; round < rounds && lights.size() > 1; ++round)
    for (std::size_t k = 0; k < lights.size(); ++k) {
      std::vector<double> scales = intensities(function, lights);
      scales[k] = 0.0;
      directions[k] = climb(without(function, lights, scales), order, directions[k]);
      lights[k] = valuesIn(directions[k], order);
    }
}

}  // namespace

std::optional<DominantLight> dominantLight(std::span<const double> radiance, int order) {
  checkRadiance(radiance, order);
  const std::size_t count = coefficientCount(order);
  const std::vector<double> bright = luminanceOf(radiance, order);
  const glm::dvec3 linear(bright[3], bright[1], bright[2]);  // Y_1 = (y, z, x)
  const double length = glm::length(linear);
  if (length == 0.0) return std::nullopt;
  DominantLight light{linear / length, glm::dvec3(0.0), {radiance.begin(), radiance.end()}};
  const std::vector<double> basis = valuesIn(light.towards, order);
  const double square = product(basis, basis);
  for (int c = 0; c < 3; ++c) {
    light.irradiance[c] = std::max(0.0, product(basis, radiance.subspan(c * count, count)) / square);
    for (std::size_t i = 0; i < count; ++i) light.residual[c * count + i] -= light.irradiance[c] * basis[i];
  }
  return light;
}

DominantLights dominantLights(std::span<const double> radiance, int order, std::size_t most) {
  checkRadiance(radiance, order);
  const auto count = static_cast<std::size_t>(coefficientCount(order));
  const std::vector<double> bright = luminanceOf(radiance, order);
  const double least = 1e-9 * std::sqrt(product(bright, bright));
  std::vector<glm::dvec3> directions;
  std::vector<std::vector<double>> values;
  while (directions.size() < most) {
    const std::vector<double> rest = without(bright, values, intensities(bright, values));
    const glm::dvec3 next = highest(rest, order);
    if (!(reconstruct(rest, order, next) > least)) break;
    directions.push_back(next);
    values.push_back(valuesIn(next, order));
    turnLights(bright, order, directions, values);
  }
  DominantLights found{std::vector<DominantLights::Light>(directions.size()), {}};
  for (std::size_t k = 0; k < directions.size(); ++k) found.lights[k].towards = directions[k];
  for (std::size_t c = 0; c < 3; ++c) {
    const auto channel = radiance.subspan(c * count, count);
    const std::vector<double> scales = intensities(channel, values);
    const std::vector<double> rest = without(channel, values, scales);
    found.residual.insert(found.residual.end(), rest.begin(), rest.end());
    for (std::size_t k = 0; k < scales.size(); ++k)
      found.lights[k].irradiance[static_cast<int>(c)] = scales[k];
  }
  const auto brightness = [](const DominantLights::Light& light) {
    return glm::dot(light.irradiance,
                    glm::dvec3(luminanceWeights[0], luminanceWeights[1], luminanceWeights[2]));
  };
  std::stable_sort(found.lights.begin(), found.lights.end(),
                   [&](const auto& a, const auto& b) { return brightness(a) > brightness(b); });
  return found;
}

}  // namespace prelight::sh
