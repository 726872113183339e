#include "viewer/cubes/cube_projection.h"

#include <string>
#include <vector>

#include "basis/sh.h"
#include "basis/sh_projection.h"
#include "prelight/error.h"
#include "viewer/cubes/cube_faces.h"

namespace prelight::viewer {
namespace {

constexpr GLuint mapsUnit = 0, integralsUnit = 1, rowsUnit = 0;

int checkedOrder(int order) {
  if (order >= 1 && order <= CubeProjection::mostOrder) return order;
  throw UsageError("order of a projected cube map",
                   "1 to " + std::to_string(CubeProjection::mostOrder) + ", got " + std::to_string(order));
}

std::vector<float> integralsOver(int side, int order) {
  const std::vector<double> integrals = sh::cubeTexelIntegrals(side, order);
  return {integrals.begin(), integrals.end()};
}

void drawOver(const gl::Program& program, const gl::VertexArray& noVertices) {
  program.use();
  glBindVertexArray(noVertices.name());
  glDrawArrays(GL_TRIANGLES, 0, 3);
  glBindVertexArray(0);
}

}  // namespace

CubeProjection::CubeProjection(int side, std::size_t cubes, int order)
    : side_(side),
      order_(checkedOrder(order)),
      integrals_(gl::makeBufferTexture(std::span<const float>(integralsOver(side, order)), 1, GL_R32F,
                                       "integrals over texels of cubes")),
      rowProgram_("fullscreen.vert", "cube_rows.frag"),
      sumProgram_("fullscreen.vert", "cube_sums.frag"),
      rows_(sh::coefficientCount(order), static_cast<int>(facesOfACube) * side),
      sums_(sh::coefficientCount(order), static_cast<int>(cubes)) {
  rowProgram_.use();
  rowProgram_.set("maps", static_cast<int>(mapsUnit));
  rowProgram_.set("integrals", static_cast<int>(integralsUnit));
  sumProgram_.use();
  sumProgram_.set("rows", static_cast<int>(rowsUnit));
  sums_.bind();
  glClearColor(0.0f, 0.0f, 0.0f, 0.0f);
  glClear(GL_COLOR_BUFFER_BIT);
  gl::check("preparing the projection of cube maps");
}

void CubeProjection::project(const gl::Texture& cubes, std::size_t cube) const {
  glDisable(GL_DEPTH_TEST);
  glDisable(GL_BLEND);
  glDisable(GL_CULL_FACE);
  rows_.bind();
  rowProgram_.use();
  rowProgram_.set("shape", glm::ivec4(side_, static_cast<int>(cube), sh::coefficientCount(order_), 0));
  gl::bind(mapsUnit, GL_TEXTURE_CUBE_MAP_ARRAY, cubes);
  gl::bind(integralsUnit, GL_TEXTURE_BUFFER, integrals_.texture);
  drawOver(rowProgram_, noVertices_);
  sums_.bind();
  glViewport(0, static_cast<GLint>(cube), sums_.width(), 1);
  gl::bind(rowsUnit, GL_TEXTURE_2D, rows_.color());
  drawOver(sumProgram_, noVertices_);
  glEnable(GL_DEPTH_TEST);
  gl::check("projecting a cube map");
}

}  // namespace prelight::viewer
