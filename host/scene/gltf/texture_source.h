#pragma once

#include <array>
#include <cstddef>
#include <optional>

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

}  // namespace prelight
