#include "viewer/gl/libraries.h"

#include <initializer_list>
#include <string>

#include "base/module.h"
#include "prelight/error.h"

namespace prelight::viewer::gl {

namespace {

/// Any of the files is enough.
void requireLibrary(std::initializer_list<const char*> files, const char* package) {
  std::string reason;
  for (const char* file : files)
    if (findModule(file, reason) != nullptr) return;
  throw Error(ExitCode::NoDevice, "OpenGL", "a library cannot be loaded: " + reason,
              std::string("install it, and a driver: apt install ") + package + " libgl1-mesa-dri");
}

}  // namespace

void requireOpenGl() { requireLibrary({"libOpenGL.so.0", "libGL.so.1"}, "libgl1"); }

void requireEgl() {
  requireLibrary({"libEGL.so.1"}, "libegl1");
  requireOpenGl();
}

void requireGlx() { requireLibrary({"libGL.so.1"}, "libgl1"); }

}  // namespace prelight::viewer::gl
