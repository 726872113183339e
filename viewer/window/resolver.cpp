#include "viewer/window/resolver.h"

#include <algorithm>

namespace prelight::viewer {

Resolver::Resolver() : program_("fullscreen.vert", "resolve.frag") {}

void Resolver::resolve(const gl::Framebuffer& samples, const SampleRect& rect,
                       const gl::Framebuffer& target) const {
  const int perAxis = std::max(samples.width() / target.width(), 1);
  const bool all = rect.width == samples.width() && rect.height == samples.height();
  target.bind();
  glDisable(GL_DEPTH_TEST);
  glDisable(GL_CULL_FACE);
  glDisable(GL_BLEND);
  if (!all) {
    const int left = (rect.x + perAxis - 1) / perAxis, bottom = (rect.y + perAxis - 1) / perAxis;
    glEnable(GL_SCISSOR_TEST);
    glScissor(left, bottom, std::max((rect.x + rect.width) / perAxis - left, 0),
              std::max((rect.y + rect.height) / perAxis - bottom, 0));
  }
  program_.use();
  program_.set("picture", 0);
  program_.set("samplesPerAxis", perAxis);
  program_.set("samplesPerPixel",
               glm::vec2(samples.width(), samples.height()) / glm::vec2(target.width(), target.height()));
  gl::bind(0, GL_TEXTURE_2D, samples.color());
  glBindVertexArray(noVertices_.name());
  glDrawArrays(GL_TRIANGLES, 0, 3);
  glBindVertexArray(0);
  glDisable(GL_SCISSOR_TEST);
  gl::check("resolving samples");
}

}  // namespace prelight::viewer
