#pragma once

#include "viewer/programs/drawn_transfer.h"
#include "viewer/programs/technique_pass.h"
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

  void light(const Illumination&) override {}
  void prepare(const PictureState& picture) override;
  bool verticesMoved() override {
    moved_ = true;
    return false;
  }
  bool isBehind() const override { return shadows_.isBehind(); }
  bool isCoarse() const override { return shadows_.areCoarse(); }
  void bind(const gl::Program&) const override { shadows_.bind(); }
  void addPlan(const Illumination& light, std::vector<PlannedPass>& plan) const override;
  void describe(const Illumination&, Warnings&) const override {}

 protected:
  const CompiledScene& compiled() const { return compiled_; }
  const RenderScene& scene() const { return scene_; }

 private:
  const CompiledScene& compiled_;
  const RenderScene& scene_;
  ShadowMaps shadows_;
  bool moved_ = false;
};

}  // namespace prelight::viewer
