#pragma once

namespace prelight::viewer::gl {

/// Each throws Error(NoDevice), naming the package to install, where the system lacks a library.

/// That of OpenGL: epoxy would end the process. Called before epoxy's first function.
void requireOpenGl();

/// Those of EGL and OpenGL, which pictures without a window need.
void requireEgl();

/// That of GLX, without which there are no windows on X.
void requireGlx();

}  // namespace prelight::viewer::gl
