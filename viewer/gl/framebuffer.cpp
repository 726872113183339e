#include "viewer/gl/framebuffer.h"

#include <string>

#include "prelight/error.h"

namespace prelight::viewer::gl {

Framebuffer::Framebuffer(int width, int height, int colors)
    : width_(width), height_(height), colors_(static_cast<std::size_t>(colors)) {
  glBindRenderbuffer(GL_RENDERBUFFER, depth_.name());
  glRenderbufferStorage(GL_RENDERBUFFER, GL_DEPTH_COMPONENT32F, width, height);
  glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_.name());
  std::vector<GLenum> drawn;
  for (const Texture& color : colors_) {
    glBindTexture(GL_TEXTURE_2D, color.name());
    glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA32F, width, height, 0, GL_RGBA, GL_FLOAT, nullptr);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAX_LEVEL, 0);
    drawn.push_back(GL_COLOR_ATTACHMENT0 + static_cast<GLenum>(drawn.size()));
    glFramebufferTexture2D(GL_FRAMEBUFFER, drawn.back(), GL_TEXTURE_2D, color.name(), 0);
  }
  glDrawBuffers(static_cast<GLsizei>(drawn.size()), drawn.data());
  glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_RENDERBUFFER, depth_.name());
  const bool complete = glCheckFramebufferStatus(GL_FRAMEBUFFER) == GL_FRAMEBUFFER_COMPLETE;
  const std::string size = std::to_string(width) + "x" + std::to_string(height);
  check("making a picture of " + size);
  if (!complete)
    throw Error(ExitCode::RuntimeFailure, "OpenGL", "cannot draw into a float picture of " + size);
}

void Framebuffer::bind() const {
  glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_.name());
  glViewport(0, 0, width_, height_);
}

std::vector<glm::vec4> Framebuffer::read() const {
  std::vector<glm::vec4> pixels(static_cast<std::size_t>(width_) * height_);
  glBindFramebuffer(GL_READ_FRAMEBUFFER, framebuffer_.name());
  glPixelStorei(GL_PACK_ALIGNMENT, 4);
  glReadPixels(0, 0, width_, height_, GL_RGBA, GL_FLOAT, pixels.data());
  check("reading the picture back");
  return pixels;
}

void Framebuffer::finish() { glFinish(); }

}  // namespace prelight::viewer::gl
