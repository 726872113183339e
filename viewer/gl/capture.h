#pragma once

#include <algorithm>
#include <cstddef>

#include "viewer/gl/framebuffer.h"

namespace prelight::viewer::gl {

/// Runs vertex shaders and keeps their outputs by transform feedback; nothing is drawn.
class Capture {
 public:
  Capture() : nothing_(1, 1) {}

  /// Makes room for the state that run() needs: before textures are bound and vertex arrays used.
  void begin() const { nothing_.bind(); }

  /// Captures the outputs of the program in use for `count` vertices into a buffer, `step` vertices per draw:
  /// drivers end draws that run for seconds.
  static void run(GLuint buffer, std::size_t count, std::size_t step) {
    glEnable(GL_RASTERIZER_DISCARD);
    glBindBufferBase(GL_TRANSFORM_FEEDBACK_BUFFER, 0, buffer);
    glBeginTransformFeedback(GL_POINTS);
    for (std::size_t first = 0; first < count; first += step)
      glDrawArrays(GL_POINTS, static_cast<GLint>(first), static_cast<GLsizei>(std::min(step, count - first)));
    glEndTransformFeedback();
    glBindBufferBase(GL_TRANSFORM_FEEDBACK_BUFFER, 0, 0);
    glDisable(GL_RASTERIZER_DISCARD);
  }

 private:
  Framebuffer nothing_;  ///< without one OpenGL draws nothing, though none is drawn to
};

}  // namespace prelight::viewer::gl
