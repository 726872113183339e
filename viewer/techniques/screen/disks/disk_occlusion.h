#pragma once

#include <memory>

#include "viewer/core/occlusion_options.h"
#include "viewer/gl/program.h"
#include "viewer/gl/texture.h"
#include "viewer/techniques/screen/disks/disk_tree.h"

namespace prelight::viewer {

/// Elements of a scene in OpenGL, as techniques/screen/disks/disks.glsl occludes by them.
class DiskOcclusion {
 public:
  /// The scene outlives it.
  explicit DiskOcclusion(const CompiledScene& scene);

  /// Vertices are at other places; there may be other triangles, too.
  void sceneMoved() { moved_ = true; }

  /// Makes the elements ready and binds them to a unit; `radius`: m, beyond which nothing occludes.
  void prepare(const ScreenOcclusionOptions& options, double radius, GLuint unit);

  /// Sets the uniforms of disks.glsl in the program in use.
  static void setUniforms(const gl::Program& program, const ScreenOcclusionOptions& options, double radius,
                          GLuint unit);

 private:
  /// The options that elements are ready for; radius and opening matter where they are weighed.
  struct Ready {
    double size = 0.0, radius = 0.0, opening = 0.0;
    int passes = 0;

    bool operator==(const Ready&) const = default;
  };

  void upload();
  void weigh(const ScreenOcclusionOptions& options, double radius, GLuint unit);

  const CompiledScene& scene_;
  gl::Program program_;  ///< how open the backs of elements are
  std::unique_ptr<DiskTree> tree_;
  std::vector<glm::uvec3> triangles_;  ///< that it is of
  gl::BufferTexture texels_;
  gl::VertexArray noVertices_;
  Ready ready_;
  bool moved_ = false;
};

}  // namespace prelight::viewer
