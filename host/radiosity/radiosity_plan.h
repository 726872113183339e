#pragma once

#include <vector>

#include "prelight/compiled_scene.h"
#include "prelight/plan.h"

namespace prelight {

/// Passes of a bake's radiosity, with their reasons; only called where the scene has triangles.
std::vector<PlannedPass> planRadiosity(const CompiledScene& scene, const BakeRequest& request);

/// How large a bake's radiosity is.
struct RadiosityScale {
  double patchSize = 0.0;      ///< m
  std::uint32_t elements = 0;  ///< of the fronts
  /// An element's: half of what a vertex would get, as meshes have about two triangles a vertex, a power of
  /// two from 64 to 32768. Fewer where --max-memory would not hold the form factors, and the least where
  /// nothing reflects.
  std::uint32_t rays = 0;

  std::uint64_t bytes() const;  ///< that form factors may take
};

RadiosityScale radiosityScale(const CompiledScene& scene, const BakeRequest& request);

/// Throws Error (OutOfMemory) where even the least rays would find more form factors than --max-memory holds.
void checkRadiosityMemory(const RadiosityScale& scale, const BakeRequest& request);

}  // namespace prelight
