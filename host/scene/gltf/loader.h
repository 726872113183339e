#pragma once

#include <filesystem>

#include "prelight/error.h"
#include "prelight/scene.h"
#include "scene/gltf/gltf_document.h"

namespace prelight {

/// Builds the Scene of a document that readGltf has checked: transforms, strips and fans, sparse, normalised
/// and quantised accessors, materials with decoded textures, lights and cameras in world space. Throws
/// InputError with the JSON path of what cannot be used (NaN positions among it).
Scene loadScene(const GltfDocument& document, Warnings& warnings);

}  // namespace prelight
