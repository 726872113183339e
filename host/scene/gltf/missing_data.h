#pragma once

#include <cstddef>

#include "scene/gltf/gltf_document.h"
#include "scene/gltf/json_cursor.h"

namespace prelight {

/// The buffer index of views whose buffer could not be read: a document has only buffer 0.
constexpr int missingBuffer = 1;

/// Returns true when an accessor's data lie in a buffer that the file leaves out.
bool lacksData(const GltfDocument& document, std::size_t accessor);

/// Returns true when data of an attribute or of the indices of a mesh primitive lie in such a buffer.
bool lacksData(const GltfDocument& document, const JsonCursor& primitive);

}  // namespace prelight
