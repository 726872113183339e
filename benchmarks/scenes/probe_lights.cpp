#include "benchmarks/scenes/probe_lights.h"

#include <cmath>
#include <numbers>

#include "benchmarks/run/measure.h"

namespace prelight::benchmarks {

namespace {

using std::numbers::pi;
constexpr double aroundDistance = 0.7;     // of the bounds' diagonal
constexpr double insideDistance = 0.02;    // smallest distance to a surface, as a share of the diagonal
constexpr std::size_t feelers = 64;        // rays that find what surrounds a point
constexpr std::size_t mostAttempts = 512;  // per light

double diagonalOf(const CompiledScene& scene) { return glm::distance(scene.boundsMin, scene.boundsMax); }

/// Returns an element of the van der Corput sequence.
double radicalInverse(std::size_t index, std::size_t base) {
  double result = 0.0, digit = 1.0 / static_cast<double>(base);
  for (; index > 0; index /= base, digit /= static_cast<double>(base))
    result += static_cast<double>(index % base) * digit;
  return result;
}

/// Returns the i-th of `feelers` directions that are spread evenly over the sphere (a Fibonacci lattice).
glm::dvec3 feeler(std::size_t i) {
  const double z = 1.0 - (2.0 * static_cast<double>(i) + 1.0) / feelers, radius = std::sqrt(1.0 - z * z);
  const double azimuth = 2.0 * pi * static_cast<double>(i) * std::numbers::phi;
  return {radius * std::cos(azimuth), radius * std::sin(azimuth), z};
}

/// Returns whether a point lies in the open: it sees more front faces than back faces, and none close by.
bool isOpen(const CompiledScene& scene, Tracer& tracer, const glm::dvec3& point) {
  std::vector<device::Ray> rays;
  for (std::size_t i = 0; i < feelers; ++i)
    rays.push_back(rayFrom(point, feeler(i), PRELIGHT_NO_TRIANGLE, 2.0 * diagonalOf(scene)));
  const std::vector<device::Hit> hits = tracer.traceClosest(rays);
  int fronts = 0, backs = 0;
  for (std::size_t i = 0; i < feelers; ++i) {
    if (hits[i].triangle == PRELIGHT_NO_TRIANGLE) continue;
    if (hits[i].t < insideDistance * diagonalOf(scene)) return false;
    ++(glm::dot(geometricNormal(scene, hits[i].triangle), feeler(i)) < 0.0 ? fronts : backs);
  }
  return fronts >= backs;
}

}  // namespace

std::vector<glm::dvec3> lightsAround(const CompiledScene& scene, std::size_t count) {
  const glm::dvec3 centre = 0.5 * (glm::dvec3(scene.boundsMin) + glm::dvec3(scene.boundsMax));
  std::vector<glm::dvec3> lights;
  for (std::size_t i = 0; i < count; ++i) {
    const auto n = static_cast<double>(count);
    const double azimuth = 6.0 * pi * static_cast<double>(i) / n;
    // A step coprime to the usual count of 16 visits every elevation.
    const double elevation = (20.0 + 64.0 / n * static_cast<double>((7 * i) % count)) * pi / 180.0;
    const glm::dvec3 way(std::cos(elevation) * std::cos(azimuth), std::sin(elevation),
                         std::cos(elevation) * std::sin(azimuth));
    lights.push_back(centre + aroundDistance * diagonalOf(scene) * way);
  }
  return lights;
}

std::vector<glm::dvec3> lightsInside(const CompiledScene& scene, Tracer& tracer, std::size_t count) {
  const glm::dvec3 low(scene.boundsMin), size = glm::dvec3(scene.boundsMax) - low;
  std::vector<glm::dvec3> lights;
  for (std::size_t i = 1; lights.size() < count && i <= mostAttempts * count; ++i) {
    const glm::dvec3 place(radicalInverse(i, 2), radicalInverse(i, 3), radicalInverse(i, 5));
    const glm::dvec3 point = low + place * size;
    if (isOpen(scene, tracer, point)) lights.push_back(point);
  }
  return lights;
}

}  // namespace prelight::benchmarks
