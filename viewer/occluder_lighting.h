#pragma once

#include <vector>

#include "bake/bake.h"
#include "basis/median_cut.h"
#include "scene/compiled_scene.h"
#include "viewer/drawn_transfer.h"

namespace prelight::viewer {

/// Vector occluders: every light, near or far, with the shadow and the diffuse light of each occluder,
/// computed at every vertex on the host, once a light. A sky is a number of directional lights.
class OccluderLighting : public DrawnTransfer {
 public:
  /// The arguments outlive it.
  OccluderLighting(const OccluderTransfer& transfer, const CompiledScene& scene);

  void light(const Illumination& light) override;
  void bind(const gl::Program& program) const override;
  void describe(const Illumination& light, Warnings& notes) const override;

 private:
  std::vector<ShadedLight> allLights(const Illumination& light);

  const OccluderTransfer& transfer_;
  const CompiledScene& scene_;
  const Environment* cutSky_ = nullptr;  ///< that skyLights_ are of
  int cutCount_ = 0;
  std::vector<SkyLight> skyLights_;
  VertexStream accessibility_;
  VertexStream radiance_;
};

}  // namespace prelight::viewer
