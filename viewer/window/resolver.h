#pragma once

#include "viewer/core/picture_slices.h"
#include "viewer/gl/framebuffer.h"
#include "viewer/gl/program.h"

namespace prelight::viewer {

/// Brings pictures to the size of a window: means of their samples where they have several per pixel, between
/// samples where they have fewer.
class Resolver {
 public:
  Resolver();

  /// Fills the pixels of `target` all of whose samples lie in a rectangle of the picture. The larger size is
  /// a multiple of the smaller one, or nearly so.
  void resolve(const gl::Framebuffer& samples, const SampleRect& rect, const gl::Framebuffer& target) const;

 private:
  gl::Program program_;
  gl::VertexArray noVertices_;
};

}  // namespace prelight::viewer
