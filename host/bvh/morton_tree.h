#pragma once

#include <cstddef>

#include "bvh/binary_bvh.h"
#include "prelight/compiled_scene.h"

namespace prelight {

/// Sorts triangles by the Morton codes of their boxes' centres and splits ranges where the highest bit of the
/// codes changes (Lauterbach et al. 2009), down to leaves of at most eight triangles. This is the fastest
/// build; rays take more steps in its tree. The tree depends only on the scene, which must have a triangle.
BinaryBvh buildMortonTree(const CompiledScene& scene, std::size_t threads);

}  // namespace prelight
