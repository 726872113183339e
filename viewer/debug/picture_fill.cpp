#include "viewer/debug/picture_fill.h"

namespace prelight::viewer {

PictureFill::PictureFill(const char* fragmentFile) : program_("fullscreen.vert", fragmentFile) {}

void PictureFill::draw(GLenum source, GLenum destination) const {
  glDisable(GL_DEPTH_TEST);
  glDisable(GL_CULL_FACE);
  glEnable(GL_BLEND);
  glBlendFuncSeparate(source, destination, GL_ZERO, GL_ONE);
  glBindVertexArray(noVertices_.name());
  glDrawArrays(GL_TRIANGLES, 0, 3);
  glBindVertexArray(0);
  glDisable(GL_BLEND);
  glEnable(GL_DEPTH_TEST);
}

}  // namespace prelight::viewer
