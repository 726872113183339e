#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "benchmarks/run/measure.h"
#include "gi/update/live_light.h"
#include "integrators/live_virtual_lights.h"
#include "radiosity/live_radiosity.h"
#include "viewer/follow/light_follower.h"
#include "viewer/follow/posed_scene.h"
#include "viewer/window/controls.h"
#include "viewer/window/live_picture.h"
#include "viewer/window/presenter.h"
#include "viewer/window/scene_follower.h"

namespace prelight::benchmarks {

/// Options of a window that is measured.
struct WindowSettings {
  int width = 1280;  ///< pixels
  int height = 720;
  int order = 4;             ///< order of SH
  std::uint64_t rays = 256;  ///< per vertex
};

/// A scene and its sky with the data that a shading needs.
struct WindowStage {
  const BenchmarkScene& scene;
  const Environment* sky;  ///< nullptr: none
  Bake bake;
  std::optional<LiveLight> live;           ///< light light of full shading, as detailed as in the window
  std::optional<LiveRadiosity> radiosity;  ///< light of radiosity shading
  GlobalIllumination globalIllumination;
  std::optional<LiveVirtualLights> virtualLights;  ///< light paths of instant shading
  viewer::RenderInputs inputs;

  /// Bakes, or computes the light of full and instant shading. Scene, sky and device must outlive it. Throws
  /// Interrupted.
  WindowStage(const BenchmarkScene& shown, const Environment* shownSky, viewer::Shading shading,
              const WindowSettings& settings, const Device& device, const Progress& progress);

  /// Returns the follower that updates a window's light as lights change.
  std::unique_ptr<viewer::LightFollower> makeFollower();

 private:
  void bakeFor(viewer::Shading shading, const WindowSettings& settings, const Device& device,
               const Progress& progress);
};

/// Processor time of all threads per part of a frame, ms.
using PartTimes = std::map<std::string, double>;

/// A window without display and panel, which does the work of a window between pictures.
class HeadlessWindow {
 public:
  /// The stage must outlive this object.
  HeadlessWindow(WindowStage& stage, viewer::Shading shading, const WindowSettings& settings);
  ~HeadlessWindow();

  viewer::Controls& controls() { return controls_; }

  /// Runs one round of the window's loop. `settled`: the view stands still.
  void frame(bool settled);

  /// Draws a frame and waits for OpenGL after each of its parts.
  PartTimes timedFrame(bool settled);

  /// Runs rounds until nothing changes by itself. Returns false if that takes more than about `mostSeconds`.
  bool settle(double mostSeconds);

  /// Starts the scene's animations. Returns false if there are none.
  bool play();

  /// Draws a still view with all its samples.
  void still();

 private:
  class Screen;

  const Scene& played_;
  viewer::PosedScene scene_;
  viewer::Renderer renderer_;
  std::unique_ptr<viewer::LightFollower> light_;  ///< nullptr: light does not change
  viewer::SceneFollower follower_;
  viewer::LivePicture picture_;
  viewer::Presenter presenter_;
  std::unique_ptr<Screen> screen_;
  viewer::Controls controls_;
};

}  // namespace prelight::benchmarks
