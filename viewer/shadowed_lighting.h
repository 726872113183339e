#pragma once

#include "viewer/drawn_transfer.h"
#include "viewer/render_scene.h"
#include "viewer/shadow_maps.h"

namespace prelight::viewer {

/// Lights of every kind with the shadows of their maps. Maps are drawn when a light is another than before,
/// none where nothing shines.
class ShadowedLighting : public DrawnTransfer {
 public:
  /// Everything outlives it.
  ShadowedLighting(const CompiledScene& compiled, const RenderScene& scene)
      : compiled_(compiled), scene_(scene) {}

  void light(const Illumination& light) override;
  void bind(const gl::Program& program) const override;
  void describe(const Illumination& light, Warnings& notes) const override;

  /// The scene's vertices are at other places: all shadow maps are drawn anew with the next light().
  virtual void sceneMoved() { moved_ = true; }

  /// Further pictures would show more of what has moved.
  virtual bool isBehind() const { return shadows_.isBehind(); }

  /// Of the shadow maps that a light() draws.
  void setShadowEffort(const ShadowMaps::Effort& effort) { effort_ = effort; }

  const ShadowMaps& shadows() const { return shadows_; }

 protected:
  const CompiledScene& compiled() const { return compiled_; }
  const RenderScene& scene() const { return scene_; }
  const ShadowMaps::Effort& effort() const { return effort_; }

 private:
  const CompiledScene& compiled_;
  const RenderScene& scene_;
  ShadowMaps shadows_;
  bool moved_ = false;
  ShadowMaps::Effort effort_;
};

}  // namespace prelight::viewer
