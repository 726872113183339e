#pragma once

namespace prelight::viewer::gl {

/// Each throws Error(NoDevice), naming the package to install, where the system lacks a library.

/// Loads OpenGL's library, for want of which epoxy would end the process. Called before epoxy's first
/// function.
void requireOpenGl();

/// Loads the libraries of EGL and OpenGL, which pictures without a window need.
void requireEgl();

/// Loads the library of GLX, without which there are no windows on X.
void requireGlx();

}  // namespace prelight::viewer::gl
