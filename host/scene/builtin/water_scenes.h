#pragma once

#include "scene/gltf/gltf_document.h"

namespace prelight {

/// Returns a sea floor with a black pearl, rocks and coral under a plane of water. Lamps shine from close
/// above the water. After Figures 1.3, 7.15 and 7.16 of Sherif's thesis (2013), in which waves bend shadows
/// and caustics.
GltfDocument makeOceanScene();

/// Returns a lake between shores under three low lamps. After Figure 1.4 of Sherif's thesis (2013), in which
/// waves bend normals and caustics, and lamps flicker.
GltfDocument makeLakeScene();

}  // namespace prelight
