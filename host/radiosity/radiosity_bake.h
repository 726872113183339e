#pragma once

#include "prelight/bake.h"
#include "prelight/compiled_scene.h"
#include "prelight/plan.h"
#include "radiosity/radiosity.h"
#include "receivers/fit_mesh.h"

namespace prelight {

/// How a bake solves for radiosity. Throws Error (OutOfMemory) where even the least rays would find more form
/// factors than the request's memory holds.
RadiosityOptions radiosityOptions(const CompiledScene& scene, const BakeRequest& request);

/// The radiosity of a bake: Bake::irradiance under the scene's own lights and the request's sky.
class RadiosityBake {
 public:
  /// `scene` and `tracer` outlive it.
  RadiosityBake(const CompiledScene& scene, const BakeRequest& request, Tracer& tracer);

  /// Throws Interrupted.
  std::vector<glm::vec3> run(const FitMesh& mesh, Progress& progress, BakeReport& report);

 private:
  const CompiledScene& scene_;
  const BakeRequest& request_;
  Radiosity radiosity_;
};

}  // namespace prelight
