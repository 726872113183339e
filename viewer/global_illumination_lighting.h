#pragma once

#include <span>

#include "gi/global_illumination.h"
#include "viewer/drawn_transfer.h"
#include "viewer/light_map_lighting.h"
#include "viewer/render_scene.h"
#include "viewer/shadow_maps.h"

namespace prelight::viewer {

/// All light: lights of every kind with the shadows of their maps, and indirect light of a light map.
/// Shadow maps are drawn when a light is another than before, none where nothing shines.
class GlobalIlluminationLighting : public DrawnTransfer {
 public:
  /// Everything outlives it.
  GlobalIlluminationLighting(const GlobalIllumination& globalIllumination, const CompiledScene& compiled,
                             const RenderScene& scene);

  void light(const Illumination& light) override;
  void bind(const gl::Program& program) const override;
  void describe(const Illumination& light, Warnings& notes) const override;

  /// Replaces the indirect irradiance, W/m2, [y][x][channel 3] of the light map's layout. Throws Error for
  /// another number of values.
  void updateIndirect(std::span<const float> values);

  /// The scene's vertices are at other places: all shadow maps are drawn anew with the next light().
  void sceneMoved() { moved_ = true; }

  /// Of the shadow maps that a light() draws.
  void setShadowEffort(const ShadowMaps::Effort& effort) { effort_ = effort; }

  const ShadowMaps& shadows() const { return shadows_; }

 private:
  const CompiledScene& compiled_;
  const RenderScene& scene_;
  LightMapLighting indirect_;
  ShadowMaps shadows_;
  bool moved_ = false;
  ShadowMaps::Effort effort_;
};

}  // namespace prelight::viewer
