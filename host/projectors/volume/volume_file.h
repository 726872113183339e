#pragma once

#include <nlohmann/json.hpp>

#include "prelight/transfer.h"
#include "scene/gltf/gltf_document.h"
#include "scene/gltf/json_cursor.h"

namespace prelight {

/// The member `volume` of the root's PRELIGHT_transfer; its values are appended to the document.
nlohmann::ordered_json volumeToJson(GltfDocument& document, const VolumeTransfer& volume);

/// Reads it back. `root` is the whole glTF object. Throws InputError when it does not fit itself.
VolumeTransfer readVolume(const GltfDocument& document, const JsonCursor& root, const JsonCursor& json);

}  // namespace prelight
