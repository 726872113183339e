#pragma once

#include "viewer/gl/framebuffer.h"
#include "viewer/gl/program.h"

namespace prelight::viewer {

/// Shows a supersampled picture of linear radiance with the display transform of toneMap
/// (host/include/prelight/picture.h).
class Presenter {
 public:
  Presenter();

  /// Radiance is multiplied by `exposure`. Draws into framebuffer object `target` (0: the window) from its
  /// lower left corner, one pixel for samplesPerAxis^2 samples.
  void present(const gl::Framebuffer& samples, int samplesPerAxis, GLuint target,
               float exposure = 1.0f) const;

 private:
  gl::Program program_;
  gl::VertexArray noVertices_;
};

}  // namespace prelight::viewer
