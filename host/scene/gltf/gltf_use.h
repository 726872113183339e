#pragma once

#include <cstddef>
#include <nlohmann/json.hpp>
#include <set>

namespace prelight {

/// The parts of a glTF file that Prelight may read, by index; parts that are not in it may be broken. Indices
/// may be out of range.
struct GltfUse {
  std::set<std::size_t> accessors;       ///< accessors of meshes, animations, instances and baked data
  std::set<std::size_t> dracoAccessors;  ///< accessors that KHR_draco_mesh_compression fills
  /// Buffer views of these accessors, of images that textures show and of Draco data.
  std::set<std::size_t> bufferViews;
  std::set<std::size_t> buffers;   ///< buffers of these views
  std::set<std::size_t> images;    ///< images that textures show
  std::set<std::size_t> cameras;   ///< cameras of nodes
  std::set<std::size_t> lights;    ///< lights of nodes
  std::set<std::size_t> profiles;  ///< profiles of nodes' lamps (EXT_lights_ies)
  std::set<std::size_t> skins;     ///< skins of nodes
};

/// Returns the parts that a tree of any shape, checked or not, uses.
GltfUse findUse(const nlohmann::ordered_json& root);

}  // namespace prelight
