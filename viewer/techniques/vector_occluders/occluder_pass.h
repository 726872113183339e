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

  /// Replaces the records: others of as many vertices, with the same vectors. Throws as the constructor.
  void setTransfer(const OccluderTransfer& transfer, const glm::dvec3& origin);

  /// Replaces where the vertices are and what they reflect.
  void setReceivers(std::span<const device::OccluderReceiverPoint> points);

  void light(std::span<const device::OccluderLight> lights, const OccluderShading& shading,
             const OccluderEye& eye);

  /// [vertex] of LitVertex, as light() left it.
  const gl::Buffer& lit() const { return lit_; }
  std::vector<device::LitVertex> read() const;

 private:
  void prepare(const device::OccluderTerms& terms);

  void upload(const OccluderTransfer& transfer);

  OccluderUpload upload_;
  std::size_t vertices_ = 0;
  gl::Program prepareProgram_, lightProgram_;
  gl::BufferTexture records_, owners_, offsets_, receivers_, waves_, prepared_, lights_;
  std::size_t preparedTexels_ = 0;  ///< that prepared_ has room for
  gl::Buffer lit_;
  gl::VertexArray noVertices_;
  gl::Capture capture_;
  std::optional<device::OccluderTerms> preparedFor_;
};

}  // namespace prelight::viewer
