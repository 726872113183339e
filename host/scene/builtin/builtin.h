#pragma once

#include <string>

#include "prelight/load.h"
#include "scene/gltf/gltf_document.h"

namespace prelight {

/// Makes a built-in scene with a camera and a light. Throws UsageError for an unknown name, listing the known
/// ones.
GltfDocument makeBuiltinScene(const std::string& name);

}  // namespace prelight
