#pragma once

#include <array>
#include <vector>

#include "basis/median_cut.h"
#include "prelight/bake.h"
#include "viewer/core/render_inputs.h"
#include "viewer/programs/drawn_transfer.h"
#include "viewer/techniques/vector_occluders/occluder_pass.h"

namespace prelight::viewer {

/// [vertex], what occluders leave of an even sky.
std::vector<float> occluderAccessibility(const OccluderTransfer& transfer);

/// Vector occluders: every light, near or far, with the shadow of each occluder and the light that it sends
/// on, computed by vertex shaders once a light, and once a place of the eye where something is glossy or
/// rough. A sky is a number of directional lights.
class OccluderLighting : public DrawnTransfer {
 public:
  /// The inputs' referents outlive it; their bake has occluders.
  explicit OccluderLighting(const RenderInputs& inputs);

  void light(const Illumination& light) override;
  bool verticesMoved() override;
  bool materialsChanged() override;
  bool takeBake(const Bake& bake) override;
  bool dependsOnEye(const Illumination& light) const override;
  void bind(const gl::Program& program) const override;
  void describe(const Illumination& light, Warnings& notes) const override;

 private:
  void followScene(bool allHighlights);
  std::vector<device::OccluderLight> allLights(const Illumination& light);
  std::vector<device::OccluderReceiverPoint> receivers() const;
  OccluderShading shadingOf(const OccluderOptions& options) const;

  RenderInputs inputs_;
  std::array<std::vector<glm::vec4>, 2> gloss_;  ///< [vertex], of metals and glass, and of all surfaces
  std::array<bool, 2> anyGloss_;                 ///< of the same
  const Environment* cutSky_ = nullptr;          ///< that skyLights_ are of
  int cutCount_ = 0;
  std::vector<SkyLight> skyLights_;
  std::vector<OccluderVector> stored_;  ///< that pass_ is made for
  bool allHighlights_ = false;          ///< what the receivers are for
  const OccluderTransfer* transfer_;    ///< of the bake
  glm::dvec3 origin_;                   ///< of the scene's coordinates that pass_ has the records in
  bool recordsChanged_ = false, receiversMoved_ = false;
  OccluderPass pass_;
  VertexStream accessibility_;
};

}  // namespace prelight::viewer
