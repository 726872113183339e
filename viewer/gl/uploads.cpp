#include "viewer/gl/uploads.h"

#include <epoxy/gl.h>

#include <algorithm>
#include <limits>

namespace prelight::viewer::gl {
namespace {

constexpr int firstVersion = 43;  // with debug messages

void count(GLenum source, GLenum type, GLuint bytes, GLenum, GLsizei, const GLchar*, const void* counter) {
  if (source != GL_DEBUG_SOURCE_APPLICATION || type != GL_DEBUG_TYPE_OTHER) return;
  *static_cast<std::size_t*>(const_cast<void*>(counter)) += bytes;
}

}  // namespace

void noteUpload(std::size_t bytes) {
  if (epoxy_gl_version() < firstVersion) return;
  constexpr std::size_t most = std::numeric_limits<GLuint>::max();
  for (std::size_t left = bytes; left > 0; left -= std::min(left, most))
    glDebugMessageInsert(GL_DEBUG_SOURCE_APPLICATION, GL_DEBUG_TYPE_OTHER,
                         static_cast<GLuint>(std::min(left, most)), GL_DEBUG_SEVERITY_NOTIFICATION, -1,
                         "bytes uploaded");
}

bool UploadCounter::works() { return epoxy_gl_version() >= firstVersion; }

UploadCounter::UploadCounter() {
  if (!works()) return;
  glDebugMessageCallback(count, &bytes_);
  glEnable(GL_DEBUG_OUTPUT);
  glEnable(GL_DEBUG_OUTPUT_SYNCHRONOUS);
}

UploadCounter::~UploadCounter() {
  if (!works()) return;
  glDisable(GL_DEBUG_OUTPUT_SYNCHRONOUS);
  glDisable(GL_DEBUG_OUTPUT);
  glDebugMessageCallback(nullptr, nullptr);
}

}  // namespace prelight::viewer::gl
