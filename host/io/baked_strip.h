#pragma once

#include <cstddef>
#include <map>
#include <string>

#include "scene/gltf/gltf_document.h"

namespace prelight {

/// Removes PRELIGHT_transfer from a document. Its accessors, buffer views and bytes are removed as far as
/// they are at the end (where embedBake() puts them) and nothing else refers to them.
void stripBake(GltfDocument& document);

/// Bytes of entries' members that are stored as bytes in place of floats (those in `quantized`, and `vo`), with
/// what their vertices share, [member].
using QuantizedBytes = std::map<std::string, std::size_t, std::less<>>;
QuantizedBytes quantizedBytes(const GltfDocument& document);

}  // namespace prelight
