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
  std::uint64_t rays = 256;  ///< a vertex
};

/// A scene and its sky with what a shading needs of them.
struct WindowStage {
  const BenchmarkScene& scene;
  const Environment* sky;  ///< nullptr: none
  Bake bake;
  std::optional<LiveLight> live;           ///< light of full shading, as detailed as the window's
  std::optional<LiveRadiosity> radiosity;  ///< light of radiosity shading
  GlobalIllumination globalIllumination;
  std::optional<LiveVirtualLights> virtualLights;  ///< light of instant shading
  viewer::RenderInputs inputs;

  /// Bakes, or computes the light of full and instant shading. Scene, sky and device outlive it. Throws
  /// Interrupted.
  WindowStage(const BenchmarkScene& shown, const Environment* shownSky, viewer::Shading shading,
              const WindowSettings& settings, const Device& device, const Progress& progress);

  /// Light of the lights that it was baked with follows, for a window.
  std::unique_ptr<viewer::LightFollower> makeFollower();

 private:
  void bakeFor(viewer::Shading shading, const WindowSettings& settings, const Device& device,
               const Progress& progress);
};

/// Milliseconds of all threads' processor time, by part of a frame.
using PartTimes = std::map<std::string, double>;

/// A window without display and panel, which does what windows do from one picture to the next.
class HeadlessWindow {
 public:
  /// The stage outlives it.
  HeadlessWindow(WindowStage& stage, viewer::Shading shading, const WindowSettings& settings);
  ~HeadlessWindow();

  viewer::Controls& controls() { return controls_; }

  /// A round of the window's loop. `settled`: the view stands still.
  void frame(bool settled);

  /// Draws a frame and waits for OpenGL after each of its parts.
  PartTimes timedFrame(bool settled);

  /// Until nothing changes by itself. False: that took more than about so many seconds.
  bool settle(double mostSeconds);

  /// The scene has animations, which it plays from now on.
  bool play();

  /// A frame of the view that stands still, all samples of it.
  void still();

 private:
  class Screen;

  const Scene& played_;
  viewer::PosedScene scene_;
  viewer::Renderer renderer_;
  std::unique_ptr<viewer::LightFollower> light_;  ///< nullptr: it stays as it is
  viewer::SceneFollower follower_;
  viewer::LivePicture picture_;
  viewer::Presenter presenter_;
  std::unique_ptr<Screen> screen_;
  viewer::Controls controls_;
};

}  // namespace prelight::benchmarks
