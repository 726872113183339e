#pragma once

#include <vector>

#include "plan/plan.h"

namespace prelight {

/// Passes of a bake's radiosity, with their reasons; only called where the scene has triangles.
std::vector<PlannedPass> planRadiosity(const CompiledScene& scene, const BakeRequest& request);

/// Rays of an element: half of what a vertex would get, as meshes have about two triangles a vertex, a power
/// of two from 64 to 32768. Fewer where --max-memory would not hold the form factors, and the least where
/// nothing reflects.
std::uint32_t radiosityRays(const CompiledScene& scene, const BakeRequest& request);

/// Bytes on the host and on the device that form factors may take.
std::uint64_t radiosityBytes(const CompiledScene& scene, const BakeRequest& request);

/// Throws Error (OutOfMemory) where even the least rays would find more form factors than --max-memory holds.
void checkRadiosityMemory(const CompiledScene& scene, const BakeRequest& request);

}  // namespace prelight
