#pragma once

#include <array>
#include <cstddef>
#include <optional>

#include "prelight/error.h"
#include "scene/gltf/json_cursor.h"

namespace prelight {

/// Extensions that give a texture another picture in place of its `source`, one that is decoded; the first
/// that a texture has counts.
constexpr std::array<const char*, 2> decodedTextureExtensions = {"EXT_texture_webp", "EXT_texture_avif"};

/// Checks the images that a texture which a material shows names. Throws InputError.
void validateTextureSource(const JsonCursor& root, const JsonCursor& texture);

/// The image that a checked texture shows; nullopt when it names none. One of KHR_texture_basisu is passed
/// over for the texture's `source`, with a warning. Throws InputError when there is no other: nothing here
/// decodes KTX2.
std::optional<std::size_t> textureImage(const JsonCursor& texture, Warnings& warnings);

}  // namespace prelight
