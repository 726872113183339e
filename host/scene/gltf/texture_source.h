#pragma once

#include <array>
#include <cstddef>
#include <optional>

#include "scene/gltf/json_cursor.h"

namespace prelight {

/// Extensions that give a texture a picture beside its `source`.
constexpr std::array<const char*, 3> textureExtensions = {"EXT_texture_webp", "EXT_texture_avif",
                                                          "KHR_texture_basisu"};

/// Checks the images that a texture which a material shows names. Throws InputError.
void validateTextureSource(const JsonCursor& root, const JsonCursor& texture);

/// The image that a checked texture shows; nullopt when it names none. WebP and AVIF count before `source`,
/// KTX2 only where there is none: block compression loses more than what stands in for it.
std::optional<std::size_t> textureImage(const JsonCursor& texture);

}  // namespace prelight
