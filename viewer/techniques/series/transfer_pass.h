#pragma once

#include <functional>
#include <optional>
#include <span>

#include "prelight/compiled_scene.h"
#include "viewer/gl/capture.h"
#include "viewer/lights/lighting.h"
#include "viewer/programs/drawn_transfer.h"

namespace prelight::viewer {

/// Texture units of techniques/sh/transfer.glsl.
enum TransferUnit : GLuint {
  transferUnit,
  transferLightUnit,
  rangesUnit,
  chBasisUnit,
  clustersUnit,
  clusterRowsUnit
};

/// How the shader comes to the radiance; numbers of techniques/sh/transfer.glsl.
enum class TransferForm : int {
  Series = 0,    ///< a dot product of stored numbers and a light's
  Clusters = 1,  ///< means and components of a cluster, lit once a light, and a vertex's weights
};

/// The side of a surface that a row of transfer belongs to; numbers of techniques/sh/transfer.glsl.
enum class TransferRow : int { Front = 0, Behind = 1 };

/// Light through stored transfer, a vertex each, by a vertex shader whose results are kept: pictures read
/// them until the light changes.
class TransferPass {
 public:
  /// The scene outlives it. The result is that attribute.
  explicit TransferPass(const CompiledScene& scene, Attribute result = Attribute::Radiance);

  /// The scene's vertices are at other places. True when what was computed depended on them.
  bool verticesMoved();

  /// `setUp` binds the textures and sets the uniforms of techniques/sh/transfer.glsl. `lamps`, those
  /// that come through the transfer, are evaluated for every vertex.
  void run(std::span<const ShadedLight> lamps, const std::function<void(const gl::Program&)>& setUp);

  /// Ties the radiance before albedo to the vertex array in use.
  void attach() const { radiance_.attach(); }

 private:
  const CompiledScene& scene_;
  gl::Program program_;
  gl::Capture capture_;
  gl::VertexArray vertexArray_;
  gl::Buffer lightBlock_;
  std::optional<VertexStream> positions_, normals_;  ///< once they are needed
  VertexStream radiance_;
};

}  // namespace prelight::viewer
