#pragma once

#include <cstddef>
#include <nlohmann/json.hpp>
#include <set>

namespace prelight {

/// The parts of a glTF file that Prelight may read, by index: what nothing of it refers to may be broken.
/// An index may lie out of range.
struct GltfUse {
  std::set<std::size_t> accessors;       ///< of meshes, animations, instances and baked data
  std::set<std::size_t> dracoAccessors;  ///< that KHR_draco_mesh_compression fills
  std::set<std::size_t> bufferViews;  ///< of those accessors, of images that textures show and of Draco data
  std::set<std::size_t> buffers;      ///< of those buffer views
  std::set<std::size_t> images;       ///< that textures show
  std::set<std::size_t> cameras;      ///< of nodes
  std::set<std::size_t> lights;       ///< of nodes
  std::set<std::size_t> profiles;     ///< of lamps (EXT_lights_ies), of nodes
  std::set<std::size_t> skins;        ///< of nodes
};

/// Looks at a tree of any shape, checked or not.
GltfUse findUse(const nlohmann::ordered_json& root);

}  // namespace prelight
