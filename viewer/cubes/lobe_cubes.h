#pragma once

#include <cstddef>

#include "viewer/gl/buffer.h"
#include "viewer/gl/framebuffer.h"
#include "viewer/gl/program.h"
#include "viewer/gl/texture.h"

namespace prelight::viewer {

/// Cube maps of surfaces through the lobes of rough ones, made on the device from cube maps that it has
/// drawn. A texel has the radiance of the surfaces in a lobe times the share of the lobe that they fill, and
/// that share: what is left shows the sky, whose map is finer. Two lobes share each level, down to levelSide:
/// the widest has a spread of 1/3 (alpha 1), each other one half the spread of the next (basis/sky_lobes.h),
/// so that texels are a third of a lobe's angle or smaller.
class LobeCubes {
 public:
  static constexpr int levelSide = 8;  ///< texels of a face in the last level

  /// `side`: texels of a face in the first level, a power of two of at least levelSide.
  LobeCubes(int side, std::size_t cubes);

  /// Takes a face of the cube that filter() is to be called for, where alpha is the distance: drawn with
  /// twice the side, or less where it may be coarse.
  void takeFace(const gl::Framebuffer& drawn, std::size_t face) const;

  /// Filters the six faces that were taken last.
  void filter(std::size_t cube) const;

  /// RGBA32F, [cube][narrower, wider] with mip levels.
  const gl::Texture& lobes() const { return lobes_; }

  int levels() const { return levels_; }

  /// Returns the spread of the lobe in a level; `wider`: the second of the two.
  double spread(int level, bool wider) const;

 private:
  void drawInto(const gl::Texture& texture, int level, std::size_t layer) const;

  int side_, levels_;
  gl::Texture source_;  ///< faces that were taken
  gl::Texture lobes_;
  gl::Program sourceProgram_, filterProgram_;
  gl::Object<gl::FramebufferTraits> target_;
  gl::VertexArray noVertices_;
};

}  // namespace prelight::viewer
