#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <string>

#include "prelight/error.h"
#include "scene/gltf/decompress.h"
#include "scene/gltf/gltf_document.h"
#include "scene/gltf/json_cursor.h"

namespace prelight {

/// Returns EXT_meshopt_compression or KHR_meshopt_compression, which describe a buffer view alike, or an
/// empty string when it has neither. The tree may have any shape.
std::string meshoptExtensionOf(const nlohmann::ordered_json& view);

/// Returns this extension of a buffer view, if it has one.
std::optional<JsonCursor> meshoptOf(const JsonCursor& view);

/// Checks the extension against the view and the buffer that it names. Throws InputError.
void validateMeshopt(const JsonCursor& root, const JsonCursor& view);

/// Removes an extension from an object that has it.
void dropExtension(nlohmann::ordered_json& holder, const std::string& name);

/// Returns the buffers that exist only for programs that cannot decompress: views name them for the decoded
/// data, and nothing is read from them. The tree may have any shape.
std::set<std::size_t> fallbackBuffers(const nlohmann::ordered_json& root);

/// Decodes every compressed buffer view of a document whose buffers are embedded; the bytes are appended to
/// the document's. A view that is broken but not used is a warning and stays without data.
void decodeMeshoptViews(GltfDocument& document, DecodedBytes& decoded, Warnings& warnings);

}  // namespace prelight
