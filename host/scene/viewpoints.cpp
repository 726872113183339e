#include "scene/viewpoints.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "scene/light_sources.h"

namespace prelight {
namespace {

/// Distance in front of an emissive triangle at which its light is taken to start, in units of the root of
/// its area.
constexpr double beforeEmitter = 0.01;

Viewpoint beforeLargestTriangle(const CompiledScene& scene, const PrimitiveRange& range) {
  std::uint32_t largest = range.firstTriangle;
  double most = 0.0;
  for (std::uint32_t t = range.firstTriangle; t < range.firstTriangle + range.triangleCount; ++t) {
    const double size = glm::length(geometricNormal(scene, t));
    if (size > most) largest = t;
    most = std::max(most, size);
  }
  const glm::uvec3& corners = scene.triangles[largest];
  const glm::dvec3 middle = (glm::dvec3(scene.positions[corners.x]) + glm::dvec3(scene.positions[corners.y]) +
                             glm::dvec3(scene.positions[corners.z])) /
                            3.0;
  return {middle + beforeEmitter / std::sqrt(most) * geometricNormal(scene, largest), false,
          fmt::format("emissive surface \"{}\"", range.name)};
}

void takeEvenly(const std::vector<Viewpoint>& from, std::size_t most, std::vector<Viewpoint>& to) {
  const std::size_t count = std::min(from.size(), most);
  for (std::size_t i = 0; i < count; ++i) to.push_back(from[i * from.size() / count]);
}

}  // namespace

std::vector<Viewpoint> viewpointsOf(const Scene& scene, const CompiledScene& compiled, std::size_t most) {
  std::vector<Viewpoint> cameras, lamps;
  for (const Camera& camera : scene.cameras)
    cameras.push_back({glm::dvec3(camera.world[3]) - compiled.origin, true, {}});
  for (const Light& light : scene.lights)
    if (light.type == LightType::Point || light.type == LightType::Spot)
      lamps.push_back({light.position - compiled.origin, false, fmt::format("light \"{}\"", light.name)});
  for (const PrimitiveRange& range : compiled.primitives) {
    if (range.triangleCount == 0) continue;
    const CompiledMaterial& material = compiled.materials[compiled.triangleMaterials[range.firstTriangle]];
    if (shines(material.emission)) lamps.push_back(beforeLargestTriangle(compiled, range));
  }
  std::vector<Viewpoint> all;
  takeEvenly(cameras, most, all);
  takeEvenly(lamps, most, all);
  return all;
}

}  // namespace prelight
