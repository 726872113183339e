#pragma once

#include <cstddef>

#include "viewer/gl/framebuffer.h"
#include "viewer/gl/program.h"
#include "viewer/gl/texture.h"

namespace prelight::viewer {

/// Spherical harmonics of cube maps that OpenGL has drawn, on the device: nothing is read back. Texels count
/// with the integrals of the functions over them, so that the sums are exact for a radiance that is constant
/// over each; a first pass sums up rows of texels and a second one the rows.
class CubeProjection {
 public:
  static constexpr int mostOrder = 4;

  /// `side`: texels of a face, a power of two. Throws UsageError for others, and for orders but 1 to 4.
  CubeProjection(int side, std::size_t cubes, int order);

  /// Projects the cube map of that number of an array of such, RGBA32F.
  void project(const gl::Texture& cubes, std::size_t cube) const;

  /// RGBA32F, [cube][i]: coefficients of what was projected, RGB.
  const gl::Texture& coefficients() const { return sums_.color(); }

  int order() const { return order_; }
  const gl::Framebuffer& target() const { return sums_; }

 private:
  int side_, order_;
  gl::BufferTexture integrals_;  ///< [texel][i]
  gl::Program rowProgram_, sumProgram_;
  gl::VertexArray noVertices_;
  gl::Framebuffer rows_;  ///< [face][row][i]
  gl::Framebuffer sums_;
};

}  // namespace prelight::viewer
