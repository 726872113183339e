#pragma once

#include <vector>

#include "basis/median_cut.h"
#include "prelight/compiled_scene.h"
#include "prelight/picture.h"
#include "viewer/lights/lighting.h"

namespace prelight::viewer {

/// Samples that stand for large lights in global illumination: all emissive triangles, and the sky.
class LightSamples {
 public:
  static constexpr int emitterCount = 64;
  static constexpr int skyCount = 64;

  /// `bodies`: glowingBodies() of the scene.
  LightSamples(const CompiledScene& scene, std::vector<BodySide> bodies);

  /// Anew, where the scene has moved.
  void setScene(const CompiledScene& scene);

  /// Samples of emitters, if wanted, and of a sky turned by `rotation` radians about +Y (nullptr: none).
  std::vector<ShadedLight> of(bool emitters, const Environment* sky, double rotation);

 private:
  std::vector<BodySide> bodies_;  ///< glowingBodies()
  std::vector<ShadedLight> emitters_;
  std::vector<SkyLight> skyLights_;
  const Environment* cutSky_ = nullptr;
};

}  // namespace prelight::viewer
