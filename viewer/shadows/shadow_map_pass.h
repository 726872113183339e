#pragma once

#include <cstddef>
#include <vector>

#include "viewer/programs/technique_pass.h"
#include "viewer/shadows/shadow_maps.h"

namespace prelight::viewer {

/// Shadow maps for the lamps of shadings that do not show all light: of those that the shading's own data
/// know nothing of, or of all (View::direct). A lamp that the transfer holds keeps its diffuse light there,
/// and its highlights have the map's shadow. Lamps of a size have a map for each of their parts.
class ShadowMapPass final : public TechniquePass {
 public:
  /// Everything outlives it.
  ShadowMapPass(const CompiledScene& compiled, const RenderScene& scene)
      : compiled_(compiled), scene_(scene) {}

  void shadow(const View& view, std::vector<ShadedLight>& lights) override;
  void shadowSamples(std::span<const ShadedLight> lights, std::span<ShadedLight> samples) const override;
  void prepare(const PictureState& picture, SceneDrawer&) override;
  void addFeatures(Features& features) const override;
  void bindTextures() const override;
  bool isBehind() const override { return !casters_.empty() && maps_.isBehind(); }
  void sceneMoved() override { moved_ = true; }
  void addPlan(std::vector<PlannedPass>& plan) const override;

 private:
  void give(ShadedLight& light, std::vector<ShadedLight> parts);

  const CompiledScene& compiled_;
  const RenderScene& scene_;
  ShadowMaps maps_;
  std::vector<ShadedLight> casters_;  ///< of the last picture, [map]
  bool moved_ = false;
};

}  // namespace prelight::viewer
