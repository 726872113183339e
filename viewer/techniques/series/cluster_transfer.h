#pragma once

#include <optional>

#include "prelight/bake.h"
#include "viewer/gl/texture.h"
#include "viewer/programs/drawn_transfer.h"
#include "viewer/techniques/series/transfer_pass.h"

namespace prelight::viewer {

/// SH transfer compressed to clusters (PCA, VQ, clustered PCA). What vertices share is lit once a light on
/// the host (relight/device/compressed_light.h); a vertex shader sums a vertex's own weights. For lamps at a finite
/// distance it decodes the vertex's transfer.
class ClusterTransfer : public DrawnTransfer {
 public:
  /// The scene outlives it.
  ClusterTransfer(const CompressedTransfer& transfer, const CompiledScene& scene);

  void light(const Illumination& light) override;
  bool verticesMoved() override { return pass_.verticesMoved(); }
  void bind(const gl::Program& program) const override;
  void describe(const Illumination&, Warnings&) const override {}

 private:
  CompressedTransfer shared_;  ///< without what belongs to vertices
  gl::BufferTexture clusters_;
  gl::BufferTexture weights_;
  gl::BufferTexture terms_;
  std::optional<gl::BufferTexture> rows_;  ///< clusterRows of techniques/sh/transfer.glsl, once lamps shine
  VertexStream accessibility_;
  TransferPass pass_;
};

}  // namespace prelight::viewer
