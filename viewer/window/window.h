#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "viewer/core/render_inputs.h"
#include "viewer/core/render_options.h"
#include "viewer/follow/light_follower.h"
#include "viewer/follow/object_follower.h"
#include "viewer/follow/posed_scene.h"

namespace prelight::viewer {

/// Inputs of the window; the same as those of a picture.
using ViewerInputs = RenderInputs;

/// How an animation is played from the start on.
struct PlayOptions {
  bool plays = false;
  std::optional<std::size_t> animation;  ///< into Scene::animations; none: that of the scene's moment, or the
                                         ///< first
  double speed = 1.0;
  bool loops = true;
};

struct ViewerOptions {
  RenderOptions render;  ///< first view; width and height are the window's, in pixels
  std::string title = "prelight";
  std::vector<LightFollower*> followers;  ///< of shadings whose light does not stay as it is
  ObjectFollower* objects = nullptr;      ///< that were not baked with the scene; nullptr: there are none
  int selectedNode = -1;                  ///< dragged at first, its number in the glTF file; -1: any
  std::vector<std::string> groups;        ///< of a follower's lights; the bake's light groups come before
  PoseSources pose;                       ///< of inputs that are posed already
  PlayOptions play;
  int frames = 0;  ///< closes after this many frames; 0: when the user closes the window
  /// Factor of radiance in the window and in .png screenshots; none: metered from the first view.
  std::optional<double> exposure = 1.0;
  std::function<void(double)> metered;           ///< is told the exposure that was metered; empty: nobody is
  std::function<void(const std::string&)> note;  ///< is told what does not follow a pose; empty: nobody is
  std::filesystem::path screenshotPath;  ///< written after the last frame, without the overlay; empty: none
};

/// Opens a window on the scene and returns when it is closed. Press H in it for the keys and mouse. A file
/// that is dropped on it closes it, too, and is returned; then no screenshot is taken. The bake may carry
/// less than every shading needs: those shadings are then not offered. Throws Error without a display or
/// OpenGL 4.1, and what renderPicture throws.
std::optional<std::filesystem::path> runViewer(const ViewerInputs& inputs, const ViewerOptions& options);

}  // namespace prelight::viewer
