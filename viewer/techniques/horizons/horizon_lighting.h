#pragma once

#include <vector>

#include "prelight/compiled_scene.h"
#include "prelight/transfer.h"
#include "viewer/gl/texture.h"
#include "viewer/programs/drawn_transfer.h"

namespace prelight::viewer {

/// The sky and lights above the horizons of vertices (host/techniques/horizons/horizon_bands.h): the sky is
/// lit a vertex, whenever it changes, lights in the fragment shader.
class HorizonLighting : public DrawnTransfer {
 public:
  /// The scene outlives it.
  HorizonLighting(const HorizonTransfer& horizons, const CompiledScene& scene);

  void light(const Illumination& light) override;
  bool verticesMoved() override { return true; }
  void bind(const gl::Program& program) const override;
  void describe(const Illumination&, Warnings&) const override {}

 private:
  const CompiledScene& scene_;
  HorizonTransfer horizons_;
  gl::BufferTexture bands_;  ///< [vertex][sector]
  VertexStream accessibility_;
  VertexStream sky_;  ///< before the albedo
  float softness_ = 0.0f;
};

}  // namespace prelight::viewer
