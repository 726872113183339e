#pragma once

#include <optional>
#include <span>
#include <vector>

#include "occluders/occluder_upload.h"
#include "viewer/gl/capture.h"
#include "viewer/gl/program.h"
#include "viewer/gl/texture.h"

namespace prelight::viewer {

/// Light through vector occluders by OpenGL: OccluderRelighter in vertex shaders of the same source, whose
/// results transform feedback captures. A record is prepared and a vertex is lit once, not once a picture.
class OccluderPass {
 public:
  /// `points`: [vertex]. Throws Error when OpenGL cannot hold the records.
  OccluderPass(const OccluderTransfer& transfer, const glm::dvec3& origin,
               std::span<const device::OccluderReceiverPoint> points);

  /// Replaces what the vertices reflect.
  void setReceivers(std::span<const device::OccluderReceiverPoint> points);

  void light(std::span<const device::OccluderLight> lights, const OccluderShading& shading,
             const OccluderEye& eye);

  /// [vertex] of LitVertex, as light() left it.
  const gl::Buffer& lit() const { return lit_; }
  std::vector<device::LitVertex> read() const;

 private:
  void prepare(const device::OccluderTerms& terms);

  OccluderUpload upload_;
  std::size_t vertices_ = 0;
  gl::Program prepareProgram_, lightProgram_;
  gl::BufferTexture records_, owners_, offsets_, receivers_, waves_, prepared_, lights_;
  gl::Buffer lit_;
  gl::VertexArray noVertices_;
  gl::Capture capture_;
  std::optional<device::OccluderTerms> preparedFor_;
};

}  // namespace prelight::viewer
