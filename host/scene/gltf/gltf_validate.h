#pragma once

#include <fmt/format.h>

#include "prelight/error.h"
#include "scene/gltf/gltf_document.h"
#include "scene/gltf/gltf_use.h"
#include "scene/gltf/json_cursor.h"

namespace prelight {

/// Checks the JSON tree of a glTF file: types of every field that Prelight uses, index ranges, accessors
/// against buffer views and buffers, the node hierarchy, required extensions. Touches no binary data. Throws
/// InputError with the JSON path; what is odd but usable, or broken but not used, becomes a warning.
void validateGltf(const JsonCursor& root, Warnings& warnings);

/// Checks what only the embedded binary data tells: sparse and vertex indices.
void validateBinaryData(const GltfDocument& document);

/// Check one accessor or buffer view with all that it refers to. Throw InputError. An accessor that is filled
/// from compressed data may have any count until then.
void validateAccessor(const JsonCursor& root, const JsonCursor& accessor, bool filledLater = false);
void validateBufferView(const JsonCursor& root, const JsonCursor& view);

/// Runs the check of a part. A complaint about one that nothing uses is but a warning.
template <class Check>
void checkPart(bool used, Warnings& warnings, Check check) {
  if (used) return check();
  try {
    check();
  } catch (const InputError& error) {
    warnings.push_back(fmt::format("{}; nothing uses it", error.what()));
  }
}

/// The parts of validateGltf, each for a file of its own.
void validateExtensionLists(const JsonCursor& root, Warnings& warnings);
void validateBuffers(const JsonCursor& root, const GltfUse& use, Warnings& warnings);
void validateAccessors(const JsonCursor& root, const GltfUse& use, Warnings& warnings);
void validateMeshes(const JsonCursor& root);
void validateNodes(const JsonCursor& root);
void validateSkins(const JsonCursor& root, const GltfUse& use, Warnings& warnings);
/// Of morph targets and weights that do not fit; after all else is checked.
void warnOfMorphs(const JsonCursor& root, Warnings& warnings);
void validateCamerasAndLights(const JsonCursor& root, const GltfUse& use, Warnings& warnings);
void validateMaterials(const JsonCursor& root, const GltfUse& use, Warnings& warnings);

}  // namespace prelight
