#pragma once

#include <string>
#include <vector>

#include "scene/gltf/gltf_document.h"

namespace prelight {

/// Name and one-line description of every built-in scene.
struct BuiltinScene {
  std::string name;
  std::string description;
};

const std::vector<BuiltinScene>& builtinScenes();

/// Makes a built-in scene with a camera and a light. Throws UsageError for an unknown name, listing the known
/// ones.
GltfDocument makeBuiltinScene(const std::string& name);

}  // namespace prelight
