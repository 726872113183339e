#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "prelight/compiled_scene.h"

namespace prelight {

/// Whether rays find meshes that are drawn more than once by way of a tree that they share.
struct Instancing {
  bool used = false;
  std::string reason;
  std::vector<std::uint32_t> instances;  ///< into CompiledScene::instances, ascending; empty unless used
  std::uint64_t storedTriangles = 0;     ///< on the device: those of no instance, and each shape's once
  std::uint64_t storedVertices = 0;
};

/// Used where many triangles are saved, as entering an instance costs a ray time.
Instancing chooseInstancing(const CompiledScene& scene);

/// Used for every shape that is large enough for a tree of its own, however little that saves.
Instancing instanceAll(const CompiledScene& scene);

}  // namespace prelight
