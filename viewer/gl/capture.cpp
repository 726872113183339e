#include "viewer/gl/capture.h"

#include <algorithm>

namespace prelight::viewer::gl {

void Capture::run(GLuint buffer, std::size_t count, std::size_t step) {
  glEnable(GL_RASTERIZER_DISCARD);
  glBindBufferBase(GL_TRANSFORM_FEEDBACK_BUFFER, 0, buffer);
  glBeginTransformFeedback(GL_POINTS);
  for (std::size_t first = 0; first < count; first += step)
    glDrawArrays(GL_POINTS, static_cast<GLint>(first), static_cast<GLsizei>(std::min(step, count - first)));
  glEndTransformFeedback();
  glBindBufferBase(GL_TRANSFORM_FEEDBACK_BUFFER, 0, 0);
  glDisable(GL_RASTERIZER_DISCARD);
}

}  // namespace prelight::viewer::gl
