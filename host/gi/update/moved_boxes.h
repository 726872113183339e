#pragma once

#include <span>
#include <vector>

#include "bvh/box.h"
#include "prelight/compiled_scene.h"
#include "shared/ray_types.h"

namespace prelight {

/// Boxes around triangles where they are now: one for each run of consecutive ones (an object's primitive),
/// few in all. `triangles` ascend.
std::vector<Box> boxesAround(const CompiledScene& scene, std::span<const std::uint32_t> triangles);

/// Whether a ray may meet a box before it ends; true in doubt.
bool mayMeet(const device::Ray& ray, const Box& box);

}  // namespace prelight
