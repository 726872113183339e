#pragma once

#include "occluders/occluder_light.h"

namespace prelight::viewer {

constexpr int mostSkyLights = 4096;  ///< upper limit of OccluderOptions::skyLights

/// How vector occluders are lit.
struct OccluderOptions {
  OccluderShading shading;
  int skyLights = defaultSkyLights;  ///< directional lights that represent a sky, >= 1
  bool allHighlights = false;        ///< lights reflect off all surfaces, not only off metals and glass
  double waveLength = 0.0;           ///< of the longest wave, m; 0: half the scene's radius
  double seconds = 0.0;              ///< time of the effects

  bool operator==(const OccluderOptions&) const = default;
};

}  // namespace prelight::viewer
