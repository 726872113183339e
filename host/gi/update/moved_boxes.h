#pragma once

#include <span>
#include <vector>

#include "bvh/box.h"
#include "prelight/compiled_scene.h"
#include "shared/ray_types.h"

namespace prelight {

/// Returns a few boxes around triangles at their present places, one for each run of consecutive triangles
/// (an object's primitive). `triangles` ascend.
std::vector<Box> boxesAround(const CompiledScene& scene, std::span<const std::uint32_t> triangles);

/// Returns whether a ray may meet a box before its end; true in case of doubt.
bool mayMeet(const device::Ray& ray, const Box& box);

}  // namespace prelight
