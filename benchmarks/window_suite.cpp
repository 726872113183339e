#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <ctime>
#include <functional>
#include <memory>
#include <numbers>
#include <optional>

#include "benchmarks/measure.h"
#include "benchmarks/suites.h"
#include "gi/update/live_light.h"
#include "viewer/controls.h"
#include "viewer/gl/egl_context.h"
#include "viewer/live_follower.h"
#include "viewer/live_picture.h"
#include "viewer/moved_scene.h"
#include "viewer/presenter.h"
#include "viewer/scene_follower.h"
#include "viewer/view.h"

namespace prelight::benchmarks {

namespace {

using viewer::Command;
using viewer::Drag;
using viewer::Shading;

constexpr int samplesPerAxis = 2;        // of pictures that stand still
constexpr double dragged = 0.01;         // window heights a frame
constexpr int mostSettlingFrames = 400;  // until light that follows has settled

/// As `prelight view` sets it up (cli/drawn_global_illumination.cpp).
LiveLightOptions followingOptions(int pixels) {
  LiveLightOptions options;
  options.photons = 50000;
  options.texels = static_cast<std::uint32_t>(std::clamp(pixels / 32, 4096, 65536));
  options.gather.rays = 128;
  options.gather.texelsPerFrame = 100;
  options.photonsPerFrame = 4000;
  options.causticPhotons = 20000;
  return options;
}

/// What is drawn into: eight bits a channel, as windows have.
class Screen {
 public:
  Screen(int width, int height) {
    glBindRenderbuffer(GL_RENDERBUFFER, color_.name());
    glRenderbufferStorage(GL_RENDERBUFFER, GL_RGBA8, width, height);
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_.name());
    glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER, color_.name());
  }
  GLuint name() const { return framebuffer_.name(); }

 private:
  viewer::gl::Renderbuffer color_;
  viewer::gl::Object<viewer::gl::FramebufferTraits> framebuffer_;
};

/// A scene with what its shading needs.
struct Stage {
  BenchmarkScene scene;
  Bake bake;
  std::optional<LiveLight> live;
  GlobalIllumination globalIllumination;
  viewer::RenderInputs inputs;

  Stage(const std::string& name, Shading shading, const BenchmarkOptions& options, const Device& device,
        const Progress& progress)
      : scene(loadBuiltinScene(name)), inputs{.scene = scene.scene, .compiled = scene.compiled} {
    if (shading == Shading::GlobalIllumination) {
      StopOnly quiet(progress);
      live.emplace(scene.scene, scene.compiled, nullptr, 0.0,
                   followingOptions(options.windowWidth * options.windowHeight), std::span<const int>(),
                   device, quiet);
      globalIllumination = illuminationOf(*live);
      inputs.globalIllumination = &globalIllumination;
    } else {
      BakeRequest request;
      request.sh.order = options.windowOrder;
      request.effort.rays = options.windowRays;
      bake = timedBake(scene, request, device, progress).bake;
      inputs.bake = &bake;
    }
  }
};

/// Seconds of frames.
struct Frames {
  std::vector<double> seconds, processor;

  void measure(const std::function<void()>& frame) {
    const std::clock_t before = std::clock();
    seconds.push_back(secondsOf(frame));
    processor.push_back(static_cast<double>(std::clock() - before) / CLOCKS_PER_SEC);
  }
};

/// What the window does from one picture to the next, but for its panel, without a display.
class HeadlessWindow {
 public:
  HeadlessWindow(Stage& stage, Shading shading, const BenchmarkOptions& options)
      : moved_(stage.scene.scene, stage.scene.compiled),
        inputs_(stage.inputs.movedTo(moved_.scene())),
        renderer_(inputs_),
        light_(stage.live ? std::make_unique<viewer::LiveFollower>(*stage.live, stage.globalIllumination) : nullptr),
        follower_(renderer_, moved_, light_.get()),
        picture_(renderer_, samplesPerAxis),
        screen_(options.windowWidth, options.windowHeight),
        controls_(viewOf(inputs_, shading, options), stage.scene.compiled, [](Shading) { return true; }) {
    renderer_.paceUpdates(true);
  }

  viewer::Controls& controls() { return controls_; }

  void frame(bool settled) {
    if (follower_.update(controls_.view()) || renderer_.isBehind()) picture_.invalidate();
    picture_.update(controls_.view(), controls_.changes(), settled);
    presenter_.present(picture_.target(), picture_.samples(), screen_.name());
    viewer::gl::Framebuffer::finish();
  }

  /// Until nothing changes by itself.
  void settle() {
    for (int i = 0; i < mostSettlingFrames; ++i) {
      frame(true);
      if (!follower_.isBusy(controls_.view()) && !renderer_.isBehind()) return;
    }
  }

  /// A frame of the view that stands still, all samples of it.
  void still() {
    picture_.invalidate();
    frame(true);
  }

 private:
  static viewer::View viewOf(const viewer::RenderInputs& inputs, Shading shading,
                             const BenchmarkOptions& options) {
    viewer::RenderOptions render;
    render.shading = shading;
    render.width = options.windowWidth;
    render.height = options.windowHeight;
    return viewer::makeView(inputs, render);
  }

  viewer::MovedScene moved_;
  viewer::RenderInputs inputs_;
  viewer::Renderer renderer_;
  std::unique_ptr<viewer::LiveFollower> light_;
  viewer::SceneFollower follower_;
  viewer::LivePicture picture_;
  viewer::Presenter presenter_;
  Screen screen_;
  viewer::Controls controls_;
};

void report(const std::string& case_, const Frames& frames, std::vector<BenchmarkResult>& results) {
  const auto add = [&](const char* metric, double seconds) {
    results.push_back({"window", case_, metric, 1e3 * seconds, "ms", {}, {}});
  };
  add("median frame", median(frames.seconds));
  add("least frame", *std::min_element(frames.seconds.begin(), frames.seconds.end()));
  add("worst frame", *std::max_element(frames.seconds.begin(), frames.seconds.end()));
  add("processor time", median(frames.processor));
}

struct Case {
  const char* scene;
  Shading shading;
};

constexpr std::array<Case, 3> cases = {
    {{"shapes", Shading::Sh}, {"cornell", Shading::Sh}, {"rooms", Shading::GlobalIllumination}}};

void measureCase(const Case& chosen, const Device& device, const BenchmarkOptions& options,
                 const Progress& progress, std::vector<BenchmarkResult>& results) {
  const std::string name = fmt::format("{}/{}", chosen.scene, viewer::shadingName(chosen.shading));
  Stage stage(chosen.scene, chosen.shading, options, device, progress);
  HeadlessWindow window(stage, chosen.shading, options);
  window.settle();
  const auto move = [&](Drag what) {
    Frames frames;
    for (int i = 0; i <= options.windowFrames; ++i) {
      progress.check();
      const double turn = 2.0 * std::numbers::pi * i / std::max(options.windowFrames, 1);
      window.controls().drag(what, {dragged, 0.3 * dragged * std::sin(turn)});
      if (i == 0)
        window.frame(false);
      else
        frames.measure([&] { window.frame(false); });
    }
    return frames;
  };
  report(name + "/orbit", move(Drag::Orbit), results);
  window.controls().run(Command::ResetView);
  if (window.controls().selectedLight() < 0) window.controls().run(Command::AddLight);
  report(name + "/moving light", move(Drag::Light), results);
  window.settle();
  Frames still;
  for (int run = 0; run < options.runs; ++run) still.measure([&] { window.still(); });
  report(name + "/still", still, results);
}

}  // namespace

std::vector<BenchmarkResult> runWindowSuite(const Device& device, const BenchmarkOptions& options,
                                            Progress& progress) {
  const viewer::gl::EglContext context;
  StepCounter steps(progress, "bench window", cases.size());
  std::vector<BenchmarkResult> results;
  for (const Case& chosen : cases) {
    measureCase(chosen, device, options, progress, results);
    steps.advance();
  }
  return results;
}

}  // namespace prelight::benchmarks
