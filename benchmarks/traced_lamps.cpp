#include "benchmarks/traced_lamps.h"

#include <cmath>

#include "base/luminance.h"
#include "scene/light_shape.h"

namespace prelight::benchmarks {
namespace {

struct Source {
  glm::dvec3 position;
  glm::dvec3 normal;      ///< of no length: light leaves it evenly all around
  double strength = 0.0;  ///< luminance of the intensity, along the normal where there is one
};

std::vector<Source> sourcesOf(const CompiledScene& scene, const Light& lamp, int samples) {
  const double light = luminance(glm::dvec3(lamp.intensity));
  if (lamp.type == LightType::Point) return {{lamp.position - scene.origin, glm::dvec3(0.0), light}};
  std::vector<Source> sources;
  for (const LightPatch& patch : patchesOf(lamp, samples))
    sources.push_back(
        {patch.position - scene.origin, patch.normal, light * shapeArea(*lamp.shape) / samples});
  return sources;
}

/// What arrives where nothing is between.
double unshadowed(const SeenPlace& place, const Source& source) {
  const glm::dvec3 path = source.position - place.position;
  const double square = glm::dot(path, path), length = std::sqrt(square);
  if (!(length > 0.0) || glm::dot(place.face, path) <= 0.0) return 0.0;
  const double leaving =
      glm::length(source.normal) > 0.0 ? std::max(-glm::dot(source.normal, path) / length, 0.0) : 1.0;
  return source.strength * leaving * std::max(glm::dot(place.normal, path) / length, 0.0) / square;
}

}  // namespace

std::vector<double> tracedIrradiance(const CompiledScene& scene, Tracer& tracer,
                                     std::span<const SeenPlace> places, const Light& lamp, int samples) {
  const double offset = seenOffset(scene);
  std::vector<double> result(places.size(), 0.0);
  for (const Source& source : sourcesOf(scene, lamp, samples)) {
    std::vector<device::Ray> rays;
    std::vector<std::size_t> lit;
    for (std::size_t i = 0; i < places.size(); ++i) {
      if (places[i].triangle == PRELIGHT_NO_TRIANGLE || !(unshadowed(places[i], source) > 0.0)) continue;
      const glm::dvec3 start = places[i].position + offset * places[i].face, path = source.position - start;
      const double distance = glm::length(path);
      rays.push_back(rayFrom(start, path / distance, places[i].triangle, distance * (1.0 - 1e-6)));
      lit.push_back(i);
    }
    const std::vector<device::Hit> hits = tracer.traceAny(rays);
    for (std::size_t r = 0; r < hits.size(); ++r)
      if (hits[r].triangle == PRELIGHT_NO_TRIANGLE) result[lit[r]] += unshadowed(places[lit[r]], source);
  }
  return result;
}

}  // namespace prelight::benchmarks
