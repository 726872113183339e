#pragma once

#include <vector>

#include "prelight/compiled_scene.h"
#include "relight/vertex_lights.h"

namespace prelight::viewer {

/// Transfer of objects that were not baked with the scene, while a window is open.
class ObjectFollower {
 public:
  virtual ~ObjectFollower() = default;

  /// Something in the scene is at another place. Returns the vertices whose transfer in the window's bake is
  /// another now.
  virtual std::vector<VertexRange> update(const CompiledScene& scene) = 0;
};

}  // namespace prelight::viewer
