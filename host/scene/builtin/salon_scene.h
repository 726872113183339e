#pragma once

#include "scene/gltf/gltf_document.h"

namespace prelight {

/// Returns a room with a French window, and the court behind it, in the sun or by a table lamp.
GltfDocument makeSalonScene();

}  // namespace prelight
