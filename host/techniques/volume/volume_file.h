#pragma once

#include <nlohmann/json.hpp>

#include "prelight/transfer.h"
#include "scene/gltf/gltf_document.h"
#include "scene/gltf/json_cursor.h"

namespace prelight {

/// The member `volume` of the root's PRELIGHT_transfer; its values, or those of `compressed` that stand for
/// them, are appended to the document.
nlohmann::ordered_json volumeToJson(GltfDocument& document, const VolumeTransfer& volume,
                                    const CompressedParts& compressed);

/// Reads it back, and what of it is compressed. `root` is the whole glTF object. Throws InputError when it
/// does not fit itself.
VolumeTransfer readVolume(const GltfDocument& document, const JsonCursor& root, const JsonCursor& json,
                          CompressedParts& compressed);

}  // namespace prelight
