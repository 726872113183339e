#include "viewer/techniques/screen/occlusion_target.h"

namespace prelight::viewer {

const gl::Framebuffer& fitted(std::optional<gl::Framebuffer>& target, int width, int height, int colors) {
  if (!target || target->width() != width || target->height() != height || target->colors() != colors) {
    glActiveTexture(GL_TEXTURE0 + scratchUnit);  // what is bound elsewhere stays
    target.emplace(width, height, colors);
  }
  return *target;
}

void drawOver(const gl::Framebuffer& target, const gl::VertexArray& noVertices) {
  glDisable(GL_DEPTH_TEST);
  glDisable(GL_CULL_FACE);
  glDisable(GL_BLEND);
  glBlendFunc(GL_ONE, GL_ZERO);  // Mesa takes one that uses two sources for several targets amiss even so
  target.bind();
  glBindVertexArray(noVertices.name());
  glDrawArrays(GL_TRIANGLES, 0, 3);
  glBindVertexArray(0);
  glEnable(GL_DEPTH_TEST);
}

void bindColors(const gl::Framebuffer& from, int count, GLuint first) {
  for (int i = 0; i < count; ++i) gl::bind(first + static_cast<GLuint>(i), GL_TEXTURE_2D, from.color(i));
}

void setSamplers(const gl::Program& program, const std::string& name, int count, GLuint first) {
  for (int i = 0; i < count; ++i)
    program.set((name + "[" + std::to_string(i) + "]").c_str(), static_cast<int>(first) + i);
}

}  // namespace prelight::viewer
