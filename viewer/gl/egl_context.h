#pragma once

#include <string>

namespace prelight::viewer::gl {

/// An OpenGL 4.1 core context without a window or a display server, current on the thread that made it.
class EglContext {
 public:
  /// Tries EGL's surfaceless platform, then its devices. Throws Error (NoDevice) when neither gives
  /// OpenGL 4.1, and where the libraries are missing.
  EglContext();
  ~EglContext();
  EglContext(const EglContext&) = delete;
  EglContext& operator=(const EglContext&) = delete;

  std::string rendererName() const;  ///< as OpenGL says it: what draws
  double version() const;            ///< 4.5

 private:
  void* display_ = nullptr;
  void* context_ = nullptr;
};

}  // namespace prelight::viewer::gl
