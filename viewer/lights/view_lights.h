#pragma once

#include <memory>
#include <vector>

#include "viewer/core/view_state.h"
#include "viewer/lights/drawn_sky.h"
#include "viewer/lights/lamp_tables.h"
#include "viewer/lights/light_samples.h"
#include "viewer/lights/lighting.h"

namespace prelight::viewer {

/// The lights of a scene's views, with samples of large lights.
class ViewLights {
 public:
  /// The scene outlives it.
  explicit ViewLights(const CompiledScene& scene);

  /// Anew, where the scene has moved.
  void setScene(const CompiledScene& scene);

  bool hasEmitters() const { return !emitters_.empty(); }

  /// At most maxLights, the strongest; samples come last. Only global illumination has samples of the sky.
  std::vector<ShadedLight> of(const View& view, const SeenSky& sky);

  /// Tables of the lights that of() returned last.
  const LampTables& tables() const { return tables_; }

  /// Leaves fewer samples of emissive surfaces, which are all the samples that `lights` holds: enough for
  /// drafts and for faces of environment maps.
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
