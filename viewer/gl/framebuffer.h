#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "viewer/gl/texture.h"

namespace prelight::viewer::gl {

/// An RGBA32F picture with a depth buffer to draw into.
class Framebuffer {
 public:
  /// Throws Error when OpenGL cannot make one of that size.
  Framebuffer(int width, int height);

  int width() const { return width_; }
  int height() const { return height_; }
  const Texture& color() const { return color_; }

  /// Makes it the target of drawing, with a viewport over all of it.
  void bind() const;

  /// The colours, rows BOTTOM to top as OpenGL has them.
  std::vector<glm::vec4> read() const;

  /// Waits until all that was drawn so far, to any target, is there.
  static void finish();

 private:
  int width_;
  int height_;
  Texture color_;
  Renderbuffer depth_;
  Object<FramebufferTraits> framebuffer_;
};

}  // namespace prelight::viewer::gl
