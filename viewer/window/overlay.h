#pragma once

#include "viewer/window/controls.h"

struct GLFWwindow;

namespace prelight::viewer {

/// The panel over the picture: frame time, shading, sky, lights, help. Owns Dear ImGui's state.
class Overlay {
 public:
  /// Installs its callbacks on the window, after those that are there, which still run. `hasSky`: a sky is
  /// drawn that can be turned.
  Overlay(GLFWwindow* window, bool hasSky);
  ~Overlay();
  Overlay(const Overlay&) = delete;
  Overlay& operator=(const Overlay&) = delete;

  /// Draws over the window's picture. `frameSeconds` is what the last picture of the scene took.
  void draw(Controls& controls, double frameSeconds);

  bool wantsMouse() const;
  bool wantsKeys() const;
  void toggleHelp() { showHelp_ = !showHelp_; }

 private:
  bool hasSky_;
  bool showHelp_ = false;
};

}  // namespace prelight::viewer
