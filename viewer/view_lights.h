#pragma once

#include <memory>
#include <vector>

#include "viewer/drawn_sky.h"
#include "viewer/lamp_tables.h"
#include "viewer/light_samples.h"
#include "viewer/lighting.h"
#include "viewer/view_state.h"

namespace prelight::viewer {

/// What shines in views of a scene, samples of large lights among it.
class ViewLights {
 public:
  /// The scene outlives it.
  explicit ViewLights(const CompiledScene& scene);

  /// Anew, where the scene has moved.
  void setScene(const CompiledScene& scene);

  bool hasEmitters() const { return !emitters_.empty(); }

  /// At most maxLights, the strongest; samples come last. Only global illumination has samples of the sky.
  std::vector<ShadedLight> of(const View& view, const SeenSky& sky);

  /// Of the lights that of() was asked for last.
  const LampTables& tables() const { return tables_; }

  /// Leaves fewer samples of emissive surfaces, which are all the samples that `lights` holds.
  void thinOut(std::vector<ShadedLight>& lights) const;

 private:
  void sample();
  std::vector<ShadedLight> shaded(std::span<const Light> lights);

  const CompiledScene* scene_;
  std::vector<BodySide> bodies_;  ///< glowingBodies()
  LampTables tables_;
  std::vector<ShadedLight> emitters_, draftEmitters_;
  std::unique_ptr<LightSamples> samples_;  ///< once they are needed
};

}  // namespace prelight::viewer
