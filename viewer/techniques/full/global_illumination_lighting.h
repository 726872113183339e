#pragma once

#include <span>

#include "gi/global_illumination.h"
#include "viewer/shadows/shadowed_lighting.h"
#include "viewer/techniques/light_map/light_map_lighting.h"

namespace prelight::viewer {

/// All light: lights with the shadows of their maps, and indirect light of a light map.
class GlobalIlluminationLighting final : public ShadowedLighting {
 public:
  /// Everything outlives it.
  GlobalIlluminationLighting(const GlobalIllumination& globalIllumination, const CompiledScene& compiled,
                             const RenderScene& scene)
      : ShadowedLighting(compiled, scene), indirect_(globalIllumination.indirect, compiled) {}

  void bind(const gl::Program& program) const override {
    indirect_.bind(program);
    ShadowedLighting::bind(program);
  }

  /// Replaces the indirect irradiance, W/m2, [y][x][channel 3] of the light map's layout. Throws Error for
  /// another number of values.
  void updateIndirect(std::span<const float> values) { indirect_.fill(values); }

 private:
  LightMapLighting indirect_;
};

}  // namespace prelight::viewer
