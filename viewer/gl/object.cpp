#include "viewer/gl/object.h"

#include <cstdio>

#include "prelight/error.h"

namespace prelight::viewer::gl {

void check(const std::string& doing) {
  const GLenum status = glGetError();
  if (status == GL_NO_ERROR) return;
  if (status == GL_OUT_OF_MEMORY) {
    throw Error(ExitCode::OutOfMemory, "OpenGL", "out of memory while " + doing,
                "draw a smaller picture or scene");
  }
  char code[16];
  std::snprintf(code, sizeof code, "0x%04x", status);
  throw Error(ExitCode::RuntimeFailure, "OpenGL", std::string("error ") + code + " while " + doing);
}

}  // namespace prelight::viewer::gl
