#include "viewer/hemisphere/texel_sums.h"

#include <bit>
#include <cstddef>

namespace prelight::viewer {
namespace {

/// The larger part first.
std::array<int, 4> countsOf(int side) {
  const int levels = std::countr_zero(static_cast<unsigned>(side)), larger = (levels + 1) / 2;
  return {1 << larger, 1 << (levels - larger), 1 << larger, 1 << (levels - larger)};
}

constexpr bool isAlongRows(std::size_t pass) { return pass < 2; }

}  // namespace

TexelSums::TexelSums(int pictureSide, int side)
    : counts_(countsOf(side)), program_("fullscreen.vert", "texel_sums.frag") {
  glm::ivec2 size(pictureSide);
  for (std::size_t pass = 0; pass < counts_.size(); ++pass) {
    (isAlongRows(pass) ? size.x : size.y) /= counts_[pass];
    targets_.emplace_back(size.x, size.y);
  }
  program_.use();
  program_.set("texels", 0);
}

void TexelSums::run(const gl::Texture& texels) const {
  glDisable(GL_DEPTH_TEST);
  glDisable(GL_BLEND);
  glDisable(GL_CULL_FACE);
  program_.use();
  glBindVertexArray(noVertices_.name());
  for (std::size_t pass = 0; pass < counts_.size(); ++pass) {
    targets_[pass].bind();
    gl::bind(0, GL_TEXTURE_2D, pass == 0 ? texels : targets_[pass - 1].color());
    const glm::ivec2 step = isAlongRows(pass) ? glm::ivec2(1, 0) : glm::ivec2(0, 1);
    program_.set("kernel", glm::ivec4(step, counts_[pass], 0));
    glDrawArrays(GL_TRIANGLES, 0, 3);
  }
  glBindVertexArray(0);
  glEnable(GL_DEPTH_TEST);
  gl::check("summing up squares of texels");
}

}  // namespace prelight::viewer
