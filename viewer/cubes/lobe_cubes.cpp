#include "viewer/cubes/lobe_cubes.h"

#include <bit>
#include <cmath>

#include "basis/sky_lobes.h"
#include "viewer/cubes/cube_faces.h"

namespace prelight::viewer {
namespace {

constexpr GLuint lobeSourceUnit = 0, lobeMapsUnit = 0;
constexpr std::size_t lobesOfALevel = 2;
constexpr double widestSpread = 1.0 / 3.0;

}  // namespace

LobeCubes::LobeCubes(int side, std::size_t cubes)
    : side_(side),
      levels_(static_cast<int>(std::bit_width(static_cast<unsigned>(side / levelSide)))),
      source_(makeCubeMaps(side, 1, true)),
      lobes_(makeCubeMaps(side, lobesOfALevel * cubes, true)),
      sourceProgram_("fullscreen.vert", "lobe_source.frag"),
      filterProgram_("fullscreen.vert", "lobe_filter.frag") {
  glBindTexture(GL_TEXTURE_CUBE_MAP_ARRAY, lobes_.name());
  glTexParameteri(GL_TEXTURE_CUBE_MAP_ARRAY, GL_TEXTURE_MAX_LEVEL, levels_ - 1);
  sourceProgram_.use();
  sourceProgram_.set("drawn", static_cast<int>(lobeSourceUnit));
  sourceProgram_.set("side", side_);
  filterProgram_.use();
  filterProgram_.set("maps", static_cast<int>(lobeMapsUnit));
  gl::check("preparing cube maps of lobes");
}

double LobeCubes::spread(int level, bool wider) const {
  return std::ldexp(widestSpread, 2 * (level + 1 - levels_) - (wider ? 0 : 1));
}

/// Draws a face with the program in use.
void LobeCubes::drawInto(const gl::Texture& texture, int level, std::size_t layer) const {
  glDisable(GL_DEPTH_TEST);
  glDisable(GL_BLEND);
  glDisable(GL_CULL_FACE);
  glBindFramebuffer(GL_FRAMEBUFFER, target_.name());
  glFramebufferTextureLayer(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, texture.name(), level,
                            static_cast<GLint>(layer));
  glViewport(0, 0, side_ >> level, side_ >> level);
  glBindVertexArray(noVertices_.name());
  glDrawArrays(GL_TRIANGLES, 0, 3);
  glBindVertexArray(0);
  glEnable(GL_DEPTH_TEST);
}

void LobeCubes::takeFace(const gl::Framebuffer& drawn, std::size_t face) const {
  sourceProgram_.use();
  gl::bind(lobeSourceUnit, GL_TEXTURE_2D, drawn.color());
  drawInto(source_, 0, face);
}

void LobeCubes::filter(std::size_t cube) const {
  gl::bind(lobeMapsUnit, GL_TEXTURE_CUBE_MAP_ARRAY, source_);
  glGenerateMipmap(GL_TEXTURE_CUBE_MAP_ARRAY);
  filterProgram_.use();
  for (int level = 0; level < levels_; ++level)
    for (std::size_t lobe = 0; lobe < lobesOfALevel; ++lobe) {
      filterProgram_.set("side", static_cast<float>(side_ >> level));
      filterProgram_.set("alpha", static_cast<float>(alphaOfSpread(spread(level, lobe == 1))));
      for (std::size_t face = 0; face < facesOfACube; ++face) {
        filterProgram_.set("face", static_cast<int>(face));
        drawInto(lobes_, level, (lobesOfALevel * cube + lobe) * facesOfACube + face);
      }
    }
  gl::check("filtering a cube map by lobes");
}

}  // namespace prelight::viewer
