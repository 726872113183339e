#include "gi/update/follow_change.h"

#include <algorithm>

#include "scene/light_sources.h"

namespace prelight {

namespace {

bool givesLight(const CompiledScene& scene, std::span<const std::uint32_t> triangles) {
  return std::any_of(triangles.begin(), triangles.end(), [&](std::uint32_t t) {
    return shines(scene.materials[scene.triangleMaterials[t]].emission);
  });
}

}  // namespace

void MovingTriangles::add(const CompiledScene& compiled, TransportScene& transport,
                          std::span<const std::uint32_t> triangles) {
  const std::size_t before = separated_.size();
  separated_.insert(separated_.end(), triangles.begin(), triangles.end());
  std::sort(separated_.begin(), separated_.end());
  separated_.erase(std::unique(separated_.begin(), separated_.end()), separated_.end());
  if (separated_.size() > before) transport.tracer().separate(compiled, separated_);
}

bool followChange(const SceneChange& change, LiveScene& scene, MovingTriangles& moving,
                  TransportScene& transport) {
  const bool grown = scene.growBounds();
  if (!change.triangles.empty()) {
    moving.add(scene.compiled(), transport, change.triangles);
    transport.follow(scene.compiled());
  }
  const bool shinesAnew = grown || !change.lights.empty() || givesLight(scene.compiled(), change.triangles);
  return shinesAnew && transport.setLights(scene.compiled(), scene.compiled().lights);
}

}  // namespace prelight
