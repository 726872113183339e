#pragma once

#include <array>
#include <cstddef>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>

#include "scene/gltf/json_cursor.h"

namespace prelight {

/// Extensions that give a texture an image besides its `source`.
constexpr std::array<const char*, 3> textureExtensions = {"EXT_texture_webp", "EXT_texture_avif",
                                                          "KHR_texture_basisu"};

/// Checks the images that a used texture names. Throws InputError.
void validateTextureSource(const JsonCursor& root, const JsonCursor& texture);

/// Returns the image of a checked texture; nullopt when it names none. WebP and AVIF are preferred to
/// `source`; KTX2 is used only without `source`, because block compression loses more than the image that
/// stands in for it.
std::optional<std::size_t> textureImage(const JsonCursor& texture);

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
