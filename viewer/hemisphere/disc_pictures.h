#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <span>

#include "prelight/compiled_scene.h"
#include "viewer/gl/framebuffer.h"
#include "viewer/gl/program.h"
#include "viewer/gl/texture.h"

namespace prelight::viewer {

/// A receiver as shaders take it.
struct DiscReceiver {
  glm::vec3 position{0.0f};         ///< scene coordinates
  std::uint32_t triangle = 0;       ///< that it lies on; noTriangle: none
  glm::mat3 frame{1.0f};            ///< columns: right, up, normal
  glm::vec3 geometricNormal{0.0f};  ///< of its triangle

  static constexpr std::uint32_t noTriangle = 0xffffffffu;
};

/// Draws discs of hemispheres exactly, although edges are arcs in them: of every triangle a rectangle that
/// encloses it is drawn, and each of its texels tests its own direction against the triangle, as a ray would.
/// A receiver's own triangle hides what lies below it. Holes of masks are open, and blended surfaces let a
/// part of the light through, by the formulas of rays (kernels/transport/alpha_funcs.cl).
class DiscPictures {
 public:
  /// `side`: texels of a picture; the atlas has room for as many pictures as fit. Throws Error for scenes
  /// that OpenGL has no room for.
  DiscPictures(const CompiledScene& scene, bool orthographic, int side, float farthest);

  /// Sets the radiance of corners, [triangle][3].
  void setRadiance(std::span<const glm::vec3> radiance);

  /// Draws a picture per receiver into an atlas, each in its tile: how much of the sky is open, 0..1, in all
  /// channels; with `radiance`, as hemisphere.frag leaves it, and what covers less than half is not there.
  void draw(const gl::Framebuffer& atlas, std::span<const DiscReceiver> receivers, bool radiance) const;

 private:
  void drawAll(int atlasSide, std::size_t count) const;

  int side_;
  std::size_t triangles_;
  gl::Program program_;
  gl::VertexArray noVertices_;
  gl::BufferTexture corners_, holed_, holes_, alphas_, radiance_;
};

}  // namespace prelight::viewer
