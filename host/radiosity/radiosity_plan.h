#pragma once

#include <vector>

#include "prelight/compiled_scene.h"
#include "prelight/plan.h"

namespace prelight {

/// Returns the passes of a bake's radiosity with their reasons. The scene must have triangles.
std::vector<PlannedPass> planRadiosity(const CompiledScene& scene, const BakeRequest& request);

/// Size of a bake's radiosity.
struct RadiosityScale {
  double patchSize = 0.0;      ///< m
  std::uint32_t elements = 0;  ///< elements of the fronts
  /// Rays per element, a power of two from 64 to 32768: half of the rays per vertex, as meshes have about two
  /// triangles per vertex. Fewer if --max-memory is too small for the form factors, and the minimum if
  /// nothing reflects.
  std::uint32_t rays = 0;

  std::uint64_t bytes() const;  ///< bytes that form factors may take
};

RadiosityScale radiosityScale(const CompiledScene& scene, const BakeRequest& request);

/// Throws Error (OutOfMemory) if the form factors would exceed --max-memory even with the fewest rays.
void checkRadiosityMemory(const RadiosityScale& scale, const BakeRequest& request);

}  // namespace prelight
