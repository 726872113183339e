#pragma once

#include <vector>

#include "prelight/bake.h"
#include "prelight/compiled_scene.h"
#include "prelight/plan.h"
#include "radiosity/radiosity.h"
#include "receivers/fit_mesh.h"

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

/// Returns the radiosity options of a bake. Throws Error (OutOfMemory) if the form factors would exceed the
/// request's memory even with the fewest rays.
RadiosityOptions radiosityOptions(const CompiledScene& scene, const BakeRequest& request);

/// Computes Bake::irradiance under the scene's own lights and the request's sky.
class RadiosityBake {
 public:
  /// `scene` and `tracer` must outlive the object.
  RadiosityBake(const CompiledScene& scene, const BakeRequest& request, Tracer& tracer);

  /// Returns the irradiance, [vertex]. Throws Interrupted.
  std::vector<glm::vec3> run(const FitMesh& mesh, Progress& progress, BakeReport& report);

 private:
  const CompiledScene& scene_;
  const BakeRequest& request_;
  Radiosity radiosity_;
};

}  // namespace prelight
