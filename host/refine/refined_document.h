#pragma once

#include <span>

#include "refine/refined_mesh.h"
#include "scene/gltf/gltf_document.h"

namespace prelight {

/// Writes subdivided primitives into the document that they come from, as lists of triangles. Attributes and
/// morph targets of a new vertex are the means of those of the vertices that it lies between; normals and
/// tangents are unit again, joints are those with the greatest mean weights, and integers that are not
/// normalised are those of one of the two vertices. Data that nothing refers to any more is removed.
void writeRefined(std::span<const RefinedPrimitive> primitives, GltfDocument& document);

}  // namespace prelight
