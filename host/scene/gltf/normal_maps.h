#pragma once

#include <vector>

#include "prelight/error.h"
#include "prelight/scene.h"
#include "scene/gltf/gltf_document.h"

namespace prelight {

/// The pictures of normal textures, which are decoded only for those who look at them.
struct NormalMaps {
  std::vector<Image> images;
  std::vector<int> imageOf;  ///< [material of the scene], into images; -1: none, or unreadable
};

/// An image that cannot be read is left out with a warning.
NormalMaps loadNormalMaps(const GltfDocument& document, const Scene& scene, Warnings& warnings);

}  // namespace prelight
