#pragma once

#include <cstddef>

#include "scene/gltf/gltf_document.h"
#include "scene/gltf/json_cursor.h"

namespace prelight {

/// The index that buffer views carry whose buffer could not be read: a document has one buffer, of index 0.
constexpr int missingBuffer = 1;

/// Whether an accessor's data lie in a buffer that the file leaves out.
bool lacksData(const GltfDocument& document, std::size_t accessor);

/// Whether an attribute or the indices of a mesh primitive do.
bool lacksData(const GltfDocument& document, const JsonCursor& primitive);

}  // namespace prelight
