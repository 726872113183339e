#pragma once

#include "base/diagnostics.h"
#include "scene/gltf_document.h"
#include "scene/json_cursor.h"

namespace prelight {

/// Checks the JSON tree of a glTF file: types of every field that Prelight uses, index ranges, accessors
/// against buffer views and buffers, the node hierarchy, required extensions. Touches no binary data. Throws
/// InputError with the JSON path; what is odd but usable becomes a warning.
void validateGltf(const JsonCursor& root, Warnings& warnings);

/// Checks what only the embedded binary data tells: sparse and vertex indices.
void validateBinaryData(const GltfDocument& document);

/// The parts of validateGltf, each for a file of its own.
void validateExtensionLists(const JsonCursor& root, Warnings& warnings);
void validateBuffers(const JsonCursor& root);
void validateAccessors(const JsonCursor& root);
void validateMeshes(const JsonCursor& root);
void validateNodes(const JsonCursor& root);
void validateCamerasAndLights(const JsonCursor& root);
void validateMaterials(const JsonCursor& root, Warnings& warnings);

}  // namespace prelight
