#include "viewer/window/presenter.h"

namespace prelight::viewer {

Presenter::Presenter() : program_("fullscreen.vert", "present.frag") {}

void Presenter::present(const gl::Framebuffer& samples, int samplesPerAxis, GLuint target,
                        float exposure) const {
  glBindFramebuffer(GL_FRAMEBUFFER, target);
  glViewport(0, 0, samples.width() / samplesPerAxis, samples.height() / samplesPerAxis);
  glDisable(GL_DEPTH_TEST);
  glDisable(GL_CULL_FACE);
  glDisable(GL_BLEND);
  program_.use();
  program_.set("picture", 0);
  program_.set("samplesPerAxis", samplesPerAxis);
  program_.set("exposure", exposure);
  gl::bind(0, GL_TEXTURE_2D, samples.color());
  glBindVertexArray(noVertices_.name());
  glDrawArrays(GL_TRIANGLES, 0, 3);
  gl::check("showing the picture");
}

}  // namespace prelight::viewer
