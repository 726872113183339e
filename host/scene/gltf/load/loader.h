#pragma once

#include <filesystem>
#include <string>

#include "prelight/error.h"
#include "prelight/scene.h"
#include "scene/gltf/gltf_document.h"

namespace prelight {

/// Builds the Scene of a document that readGltf has checked: transforms, strips and fans, sparse, normalised
/// and quantised accessors, materials with decoded textures, lights and cameras in world space. Throws
/// InputError with the JSON path of unusable data (such as NaN positions), and UsageError for a variant
/// (KHR_materials_variants) that the file lacks; without a variant primitives have their own materials.
Scene loadScene(const GltfDocument& document, Warnings& warnings, const std::string& variant = {});

}  // namespace prelight
