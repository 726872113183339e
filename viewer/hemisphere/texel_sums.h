#pragma once

#include <array>
#include <vector>

#include "viewer/gl/framebuffer.h"
#include "viewer/gl/program.h"
#include "viewer/gl/texture.h"

namespace prelight::viewer {

/// Sums over squares of texels in four passes, the first two along rows and the others along columns, each
/// into a smaller picture (Staniszewski 2005, 2.2.4, Listings 2.6 and 2.7: 8, 4, 8 and 4 texels for squares
/// of 32 x 32).
class TexelSums {
 public:
  /// `pictureSide`: texels of a side of what is summed up, a multiple of `side`, a power of two >= 8, which
  /// is that of the squares.
  TexelSums(int pictureSide, int side);

  void run(const gl::Texture& texels) const;

  /// [y][x] of the squares, once they are summed up.
  std::vector<glm::vec4> read() const { return targets_.back().read(); }

  /// How many texels each pass sums up.
  const std::array<int, 4>& counts() const { return counts_; }

 private:
  std::array<int, 4> counts_;
  gl::Program program_;
  gl::VertexArray noVertices_;
  std::vector<gl::Framebuffer> targets_;  ///< of the passes
};

}  // namespace prelight::viewer
