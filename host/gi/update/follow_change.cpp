#include "gi/update/follow_change.h"

#include <algorithm>

namespace prelight {

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
  return (!change.lights.empty() || grown) && transport.setLights(scene.compiled(), scene.compiled().lights);
}

}  // namespace prelight
