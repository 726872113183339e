#pragma once

#include "viewer/programs/drawn_transfer.h"
#include "viewer/scene/render_scene.h"
#include "viewer/shadows/shadow_maps.h"

namespace prelight::viewer {

/// Lights of every kind with the shadows of their maps. Maps are drawn when a light is another than before,
/// none where nothing shines.
class ShadowedLighting : public DrawnTransfer {
 public:
  /// Everything outlives it.
  ShadowedLighting(const CompiledScene& compiled, const RenderScene& scene)
      : compiled_(compiled), scene_(scene) {}

  void light(const Illumination& light) override {
    shadows_.update(scene_, compiled_, light.lights, moved_, effort_);
    moved_ = false;
  }
  void bind(const gl::Program&) const override { shadows_.bind(); }
  void describe(const Illumination&, Warnings&) const override {}

  /// The scene's vertices are at other places: all shadow maps are drawn anew with the next light().
  virtual void sceneMoved() { moved_ = true; }

  /// Further pictures would show more of what has moved.
  virtual bool isBehind() const { return shadows_.isBehind(); }

  /// Limits how many shadow maps a light() draws.
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
