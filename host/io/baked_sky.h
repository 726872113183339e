#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <optional>

#include "prelight/bake.h"
#include "prelight/picture.h"
#include "scene/gltf/gltf_document.h"
#include "scene/gltf/json_cursor.h"

namespace prelight {

/// Tells skies apart by their texels.
std::uint64_t skyHash(const Environment& sky);

nlohmann::ordered_json toJson(const BakedSky& sky);

/// Throws InputError for what is no sky of a bake.
BakedSky bakedSkyFromJson(const JsonCursor& json);

/// The sky that a document's light was baked under; nothing where it names none.
std::optional<BakedSky> readBakedSky(const GltfDocument& document);

}  // namespace prelight
