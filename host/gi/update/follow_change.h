#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "gi/update/live_scene.h"
#include "gpu/transport_scene.h"

namespace prelight {

/// Triangles that move, which have a tree of their own.
class MovingTriangles {
 public:
  void add(const CompiledScene& compiled, TransportScene& transport,
           std::span<const std::uint32_t> triangles);

 private:
  std::vector<std::uint32_t> separated_;  ///< ascending
};

/// Takes what is on the device to where the scene is now. True: what was kept of its light is of no use, as
/// lights of a kind that the programs do not know shine now.
bool followChange(const SceneChange& change, LiveScene& scene, MovingTriangles& moving,
                  TransportScene& transport);

}  // namespace prelight
