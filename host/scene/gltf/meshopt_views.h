#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <string>

#include "prelight/error.h"
#include "scene/gltf/decoded_bytes.h"
#include "scene/gltf/gltf_document.h"
#include "scene/gltf/json_cursor.h"

namespace prelight {

/// EXT_meshopt_compression or KHR_meshopt_compression, which say the same of a buffer view; empty when it has
/// neither. A tree of any shape.
std::string meshoptExtensionOf(const nlohmann::ordered_json& view);

/// That extension of a buffer view, when it has one.
std::optional<JsonCursor> meshoptOf(const JsonCursor& view);

/// Checks it against the view and the buffer that it names. Throws InputError.
void validateMeshopt(const JsonCursor& root, const JsonCursor& view);

/// Takes an extension off an object that has it.
void dropExtension(nlohmann::ordered_json& holder, const std::string& name);

/// Buffers that are only there for programs that cannot decompress: views name them for what they hold once
/// decoded, and nothing is read from them. A tree of any shape.
std::set<std::size_t> fallbackBuffers(const nlohmann::ordered_json& root);

/// Decodes every compressed buffer view of a document whose buffers are embedded, to bytes at the end of the
/// document's. One that is broken and not used is a warning, and stays without data.
void decodeMeshoptViews(GltfDocument& document, DecodedBytes& decoded, Warnings& warnings);

}  // namespace prelight
