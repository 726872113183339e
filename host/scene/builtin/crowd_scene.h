#pragma once

#include "scene/builtin/gltf_builder.h"
#include "scene/gltf/gltf_document.h"

namespace prelight {

/// Returns balls, rings, boxes, cones and cylinders of many colours on a ground of 16 m, every sixth of
/// polished metal, under coloured point lights. 25 objects make about 25 000 vertices and 50 000 triangles,
/// as in Sherif's thesis (2013), Figure 7.1. The scene is the same on every machine.
GltfDocument makeCrowdScene(int objects, int lights);

/// Adds one object of the crowd at its place.
void addCrowdObject(int number, bool metal, GltfBuilder& builder);

}  // namespace prelight
