#pragma once

#include <fmt/format.h>

#include <string>

#include "prelight/error.h"
#include "scene/gltf/gltf_document.h"
#include "scene/gltf/gltf_use.h"
#include "scene/gltf/json_cursor.h"

namespace prelight {

/// Checks the JSON tree of a glTF file: types of every field that Prelight uses, index ranges, accessors
/// against buffer views and buffers, the node hierarchy, required extensions. Reads no binary data. Throws
/// InputError with the JSON path; things that are odd but usable, or broken but not used, become warnings.
void validateGltf(const JsonCursor& root, Warnings& warnings);

/// Returns whether the loader reads an extension.
bool isKnownExtension(const std::string& extension);

/// Checks properties that only the embedded binary data shows: sparse and vertex indices.
void validateBinaryData(const GltfDocument& document);

/// Check one accessor or buffer view with everything to which it refers. Throw InputError. An accessor that
/// is filled from compressed data may have any count before that.
void validateAccessor(const JsonCursor& root, const JsonCursor& accessor, bool filledLater = false);
void validateBufferView(const JsonCursor& root, const JsonCursor& view);

/// Runs the check of a part. Its error becomes a warning if nothing uses the part.
template <class Check>
void checkPart(bool used, Warnings& warnings, Check check) {
  if (used) return check();
  try {
    check();
  } catch (const InputError& error) {
    warnings.push_back(fmt::format("{}; nothing uses it", error.what()));
  }
}

/// The parts of validateGltf, each in its own file.
void validateExtensionLists(const JsonCursor& root, Warnings& warnings);
void validateBuffers(const JsonCursor& root, const GltfUse& use, Warnings& warnings);
void validateAccessors(const JsonCursor& root, const GltfUse& use, Warnings& warnings);
void validateMeshes(const JsonCursor& root);
void validateNodes(const JsonCursor& root);
void validateSkins(const JsonCursor& root, const GltfUse& use, Warnings& warnings);
/// Warns of morph targets and weights that do not fit; to be called after all other checks.
void warnOfMorphs(const JsonCursor& root, Warnings& warnings);
void validateCamerasAndLights(const JsonCursor& root, const GltfUse& use, Warnings& warnings);
void validateMaterials(const JsonCursor& root, const GltfUse& use, Warnings& warnings);

}  // namespace prelight
