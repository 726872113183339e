#pragma once

#include <cstddef>

#include "viewer/gl/framebuffer.h"

namespace prelight::viewer::gl {

/// Runs vertex shaders for what they compute: transform feedback keeps it, nothing is drawn.
class Capture {
 public:
  Capture() : nothing_(1, 1) {}

  /// Makes room for the state that run() needs: before textures are bound and vertex arrays used.
  void begin() const { nothing_.bind(); }

  /// Captures what the program in use makes of `count` vertices into a buffer, `step` of them a draw: drivers
  /// end what runs for seconds.
  static void run(GLuint buffer, std::size_t count, std::size_t step);

 private:
  Framebuffer nothing_;  ///< without one OpenGL draws nothing, though none is drawn to
};

}  // namespace prelight::viewer::gl
