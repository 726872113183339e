#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <optional>

#include "prelight/bake.h"
#include "prelight/picture.h"
#include "scene/gltf/gltf_document.h"
#include "scene/gltf/json_cursor.h"

namespace prelight {

/// Returns a hash of a sky's texels.
std::uint64_t skyHash(const Environment& sky);

nlohmann::ordered_json toJson(const BakedSky& sky);

/// Throws InputError for JSON that does not describe the sky of a bake.
BakedSky bakedSkyFromJson(const JsonCursor& json);

/// Returns the sky that a document's light was baked under, or nothing if it names none.
std::optional<BakedSky> readBakedSky(const GltfDocument& document);

}  // namespace prelight
