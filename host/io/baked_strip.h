#pragma once

#include "scene/gltf/gltf_document.h"

namespace prelight {

/// Removes PRELIGHT_transfer from a document, and its accessors, buffer views and bytes as far as they lie at
/// the tail (where embedBake put them) and nothing else refers to them.
void stripBake(GltfDocument& document);

}  // namespace prelight
