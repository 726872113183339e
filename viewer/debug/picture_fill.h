#pragma once

#include "viewer/gl/program.h"

namespace prelight::viewer {

/// A fullscreen triangle whose fragment shader changes the colours of a picture and leaves its depths.
class PictureFill {
 public:
  explicit PictureFill(const char* fragmentFile);

  const gl::Program& use() const {
    program_.use();
    return program_;
  }

  /// Draws with the program in use over the framebuffer that is bound; `source` and `destination` are factors
  /// of blending.
  void draw(GLenum source, GLenum destination) const;

 private:
  gl::Program program_;
  gl::VertexArray noVertices_;
};

}  // namespace prelight::viewer
