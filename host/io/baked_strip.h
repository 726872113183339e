#pragma once

#include "scene/gltf/gltf_document.h"

namespace prelight {

/// Removes PRELIGHT_transfer from a document. Its accessors, buffer views and bytes are removed as far as
/// they are at the end (where embedBake() puts them) and nothing else refers to them.
void stripBake(GltfDocument& document);

}  // namespace prelight
