#pragma once

#include <span>

#include "gi/global_illumination.h"
#include "viewer/light_map_lighting.h"
#include "viewer/shadowed_lighting.h"

namespace prelight::viewer {

/// All light: lights with the shadows of their maps, and indirect light of a light map.
class GlobalIlluminationLighting final : public ShadowedLighting {
 public:
  /// Everything outlives it.
  GlobalIlluminationLighting(const GlobalIllumination& globalIllumination, const CompiledScene& compiled,
                             const RenderScene& scene);

  void bind(const gl::Program& program) const override;

  /// Replaces the indirect irradiance, W/m2, [y][x][channel 3] of the light map's layout. Throws Error for
  /// another number of values.
  void updateIndirect(std::span<const float> values);

 private:
  LightMapLighting indirect_;
};

}  // namespace prelight::viewer
