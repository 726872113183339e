#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "viewer/gl/texture.h"

namespace prelight::viewer::gl {

/// An RGBA32F picture with a depth buffer to draw into, or several that are drawn at once.
class Framebuffer {
 public:
  /// `colors`: pictures; shaders write to locations from 0 on. Throws Error when OpenGL cannot make one of
  /// that size.
  Framebuffer(int width, int height, int colors = 1);

  int width() const { return width_; }
  int height() const { return height_; }
  const Texture& color(int index = 0) const { return colors_[static_cast<std::size_t>(index)]; }
  int colors() const { return static_cast<int>(colors_.size()); }

  /// Makes it the target of drawing, with a viewport over all of it.
  void bind() const;

  /// The first picture's colours, rows BOTTOM to top as OpenGL has them.
  std::vector<glm::vec4> read() const;

  /// Waits until all that was drawn so far, to any target, is there.
  static void finish();

 private:
  int width_;
  int height_;
  std::vector<Texture> colors_;
  Renderbuffer depth_;
  Object<FramebufferTraits> framebuffer_;
};

}  // namespace prelight::viewer::gl
