#pragma once

#include "prelight/bake.h"
#include "prelight/compiled_scene.h"
#include "prelight/plan.h"
#include "radiosity/radiosity.h"
#include "receivers/fit_mesh.h"

namespace prelight {

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
