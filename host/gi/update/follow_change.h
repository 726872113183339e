#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "gi/update/live_scene.h"
#include "gpu/transport_scene.h"

namespace prelight {

/// Moving triangles, which are kept in a separate tree.
class MovingTriangles {
 public:
  /// Adds triangles, and rebuilds their tree if any is new.
  void add(const CompiledScene& compiled, TransportScene& transport,
           std::span<const std::uint32_t> triangles);

 private:
  std::vector<std::uint32_t> separated_;  ///< ascending
};

/// Applies a change to the scene on the device. Returns true if stored light must be discarded, because
/// lights of a kind that the programs were not built for are on now.
bool followChange(const SceneChange& change, LiveScene& scene, MovingTriangles& moving,
                  TransportScene& transport);

}  // namespace prelight
