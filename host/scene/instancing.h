#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "prelight/compiled_scene.h"

namespace prelight {

/// The decision whether rays use shared trees for meshes that are drawn more than once.
struct Instancing {
  bool used = false;
  std::string reason;
  /// Indices into CompiledScene::instances, ascending; empty unless used.
  std::vector<std::uint32_t> instances;
  /// On the device: triangles outside instances, and each shape's once.
  std::uint64_t storedTriangles = 0;
  std::uint64_t storedVertices = 0;
};

/// Uses instancing where it saves many triangles, because entering an instance costs rays time.
Instancing chooseInstancing(const CompiledScene& scene);

/// Uses instancing for every shape that is large enough for a tree of its own, however little it saves.
Instancing instanceAll(const CompiledScene& scene);

}  // namespace prelight
