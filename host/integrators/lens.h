#pragma once

#include <optional>

#include "prelight/compiled_scene.h"
#include "prelight/scene.h"

namespace prelight::reference {

/// A thin lens before the eye: points out of its focus are spread over a circle of confusion.
struct Lens {
  double aperture = 0.0;  ///< m, diameter; 0: that of fNumber
  double fNumber = 0.0;   ///< focal length over aperture for film that is filmHeight high; 0: no lens
  std::optional<double>
      focus;  ///< m of depth that is sharp; none: where the picture's middle meets the scene

  static constexpr double filmHeight = 0.024;  ///< m, of 35 mm film

  bool isPinhole() const { return aperture <= 0.0 && fNumber <= 0.0; }
};

/// Depth that is as good as infinite, m.
constexpr double infiniteFocus = 1e9;

/// Returns the depth in metres at which the line of sight first meets a triangle that pictures show there;
/// textures that cut holes are not looked at. None where it meets nothing.
std::optional<double> depthInMiddle(const Camera& camera, const CompiledScene& scene);

/// Returns a lens with its aperture in metres and its focus. A pinhole is returned as it is. Throws
/// UsageError for an f-number of an orthographic camera, which has no focal length.
Lens focused(const Lens& lens, const Camera& camera, const CompiledScene& scene);

}  // namespace prelight::reference
