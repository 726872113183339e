#include "benchmarks/suites/viewer/viewer_suite.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numbers>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "benchmarks/run/measure.h"
#include "benchmarks/run/timing.h"
#include "benchmarks/scenes/compared_scenes.h"
#include "benchmarks/suites/viewer/headless_window.h"
#include "prelight/error.h"
#include "viewer/core/shading.h"
#include "viewer/gl/egl_context.h"
#include "viewer/gl/timer_query.h"
#include "viewer/gl/uploads.h"

namespace prelight::benchmarks {

namespace {

/// A case of the suite `viewer`.
struct ViewerCase {
  std::string scene;  ///< built-in scene or file
  viewer::Shading shading;
  int width = 0;
  int height = 0;

  std::string name() const;  ///< returns "shapes/sh/640x360"

  /// Returns whether both have the same bake.
  bool sharesStage(const ViewerCase& other) const { return scene == other.scene && shading == other.shading; }
};

constexpr std::array<std::string_view, 5> knownScenes = {"shapes", "cornell", "rooms", "swing", "caustics"};
constexpr std::array<std::string_view, 2> openScenes = {"shapes", "swing"};

std::vector<std::string> scenesOf(const ViewerOptions& options) {
  std::vector<std::string> scenes = options.scenes;
  if (options.onlyCase.empty()) return scenes;
  for (const std::string_view known : knownScenes)
    if (std::find(scenes.begin(), scenes.end(), known) == scenes.end()) scenes.emplace_back(known);
  return scenes;
}

std::string ViewerCase::name() const {
  return fmt::format("{}/{}/{}x{}", sceneName(scene), viewer::shadingName(shading), width, height);
}

/// Returns every shading on every requested scene, or the cases that --case names among these and all other
/// scenes of the suite. Cases are ordered by scene, then by shading.
std::vector<ViewerCase> viewerCases(const ViewerOptions& options) {
  std::vector<ViewerCase> chosen;
  for (const std::string& scene : scenesOf(options))
    for (const viewer::ShadingInfo& shading : viewer::shadings())
      for (const auto& [width, height] : options.sizes) {
        const ViewerCase some{scene, shading.shading, width, height};
        if (some.name().find(options.onlyCase) != std::string::npos) chosen.push_back(some);
      }
  return chosen;
}

/// Throws UsageError, which says how cases are named.
void refuseViewerCase(const ViewerOptions& options) {
  throw UsageError("--case " + options.onlyCase, "no case of `viewer` has such a name",
                   fmt::format("they are SCENE/SHADING/WIDTHxHEIGHT, scenes {}; shadings {}",
                               fmt::join(knownScenes, " "), viewer::shadingNames()));
}

/// Returns whether a built-in scene is shown under a sky. Files are if they have no lights.
bool isShownUnderSky(const std::string& scene) {
  return std::find(openScenes.begin(), openScenes.end(), scene) != openScenes.end();
}

using viewer::Command;
using viewer::Controls;
using viewer::Drag;
using viewer::Shading;

constexpr double dragged = 0.01;       // window heights per frame
constexpr int framesBeforeTiming = 2;  // the first frames compile and allocate, which is no cost per frame
constexpr int leastFrames = 3;         // least number of frames of a movement, if they are cheap
constexpr double longestStart =
    20.0;  // seconds to wait for the first light, whose form factors are computed once
constexpr int skyRows = 64;

/// Shares of a movement's time for timed frames, frames with timed parts, and latencies.
constexpr double framesShare = 0.35, partsShare = 0.15, latencyShare = 0.5;

/// Share of a case's time in which light may settle before anything moves.
constexpr double settleShare = 0.15;

/// Least number of frames of a latency: all samples of a picture before and after the input, and the next.
constexpr double framesOfLatency = 9.0;

/// An input of the user that moves something.
struct Input {
  Drag drag;
  const char* name;
  void (*prepare)(Controls&);
  bool (*fits)(const Controls&, bool hasSky);
};

const std::array<Input, 4> inputs = {
    {{Drag::Orbit, "orbit", [](Controls&) {}, [](const Controls&, bool) { return true; }},
     {Drag::Light, "moving light",
      [](Controls& controls) {
        controls.run(Command::ResetView);
        if (controls.selectedLight() < 0) controls.run(Command::AddLight);
      },
      [](const Controls&, bool) { return true; }},
     {Drag::Sky, "turned sky", [](Controls&) {}, [](const Controls&, bool hasSky) { return hasSky; }},
     {Drag::Node, "moving node",
      [](Controls& controls) { controls.run(Command::NextNode); },  // the first node carries the others
      [](const Controls& controls, bool) { return controls.nodesMoveNow(); }}}};

/// Measurements of one movement.
struct Frames {
  std::vector<double> seconds, processor;
  std::vector<double> opengl;    ///< empty if the driver has no timer
  std::vector<PartTimes> parts;  ///< times of the parts of further frames
  std::vector<double> uploaded;  ///< bytes that these frames upload

  void measure(const std::function<void()>& frame) {
    const double before = processorSeconds();
    if (!viewer::gl::TimerQuery::works()) {
      seconds.push_back(secondsOf(frame));
      processor.push_back(processorSeconds() - before);
      return;
    }
    const viewer::gl::TimerQuery query;
    query.begin();
    seconds.push_back(secondsOf(frame));
    query.end();
    processor.push_back(processorSeconds() - before);
    opengl.push_back(query.seconds());
  }
};

/// Returns the value that a share of all values does not exceed.
double quantile(std::vector<double> values, double share) {
  std::sort(values.begin(), values.end());
  return values[static_cast<std::size_t>(std::ceil(share * static_cast<double>(values.size()))) - 1];
}

/// Adds rows of the suite's report.
class Rows {
 public:
  explicit Rows(std::string case_) : case_(std::move(case_)) {}

  void add(const std::string& metric, double value, const char* unit) {
    rows_.push_back({case_, metric, value, unit, {}, {}});
  }
  void addTime(const std::string& metric, double seconds) { add(metric, 1e3 * seconds, "ms"); }
  void moveTo(std::vector<BenchmarkResult>& results) {
    results.insert(results.end(), std::make_move_iterator(rows_.begin()),
                   std::make_move_iterator(rows_.end()));
  }

 private:
  std::string case_;
  std::vector<BenchmarkResult> rows_;
};

void report(const Frames& frames, Rows& rows) {
  rows.addTime("median frame", median(frames.seconds));
  rows.addTime("least frame", *std::min_element(frames.seconds.begin(), frames.seconds.end()));
  rows.addTime("95th percentile", quantile(frames.seconds, 0.95));
  rows.addTime("processor time", median(frames.processor));
  if (!frames.opengl.empty()) rows.addTime("OpenGL's timer", median(frames.opengl));
  rows.add("frames timed", static_cast<double>(frames.seconds.size()), "");
  if (!frames.uploaded.empty()) rows.add("uploaded a frame", median(frames.uploaded), "B");
  std::set<std::string> parts;
  for (const PartTimes& times : frames.parts)
    for (const auto& [part, milliseconds] : times) parts.insert(part);
  parts.erase("");  // time before the first part of a frame
  for (const std::string& part : parts) {
    std::vector<double> values;
    for (const PartTimes& times : frames.parts) values.push_back(times.contains(part) ? times.at(part) : 0.0);
    if (const double typical = median(values); typical > 0.0) rows.add("part: " + part, typical, "ms");
  }
}

/// Measures a case within its time.
class CaseTrial {
 public:
  CaseTrial(const ViewerCase& measured, WindowStage& stage, const WindowSettings& settings,
            const ViewerOptions& options, const Deadline& end, SuiteRun& run)
      : name_(measured.name()),
        options_(options),
        run_(run),
        stage_(stage),
        window_(stage, measured.shading, settings),
        end_(end) {}

  void measure() {
    std::vector<const Input*> fitting;
    for (const Input& input : inputs)
      if (input.fits(window_.controls(), stage_.sky != nullptr)) fitting.push_back(&input);
    window_.frame(false);
    frameSeconds_ = secondsOf([&] { window_.frame(false); });
    if (!isCostly(framesOfLatency, end_.left())) window_.settle(settleShare * end_.left());
    const bool plays = !stage_.scene.scene.animations.empty();
    TimeShares shares(end_.left(), static_cast<double>(fitting.size()) + (plays ? 2.0 : 1.0));
    for (const Input* input : fitting) measureInput(*input, shares.next());
    if (plays) measurePlayback(shares.next());
    measureStill(shares.next());
    if (leftOut_ > 0) {
      Rows rows(name_);
      rows.add("skipped for lack of time", leftOut_, "measurements");
      rows.moveTo(run_.results());
    }
  }

 private:
  /// Returns whether a movement is skipped for lack of time. The first is always measured.
  bool isLeftOut(double seconds) {
    const bool left = !isFirst_ && (end_.isPast() || seconds > end_.left());
    if (left) ++leftOut_;
    isFirst_ = false;
    return left;
  }

  bool isCostly(double frames, double seconds) const { return frames * frameSeconds_ > seconds; }

  void measureInput(const Input& input, double seconds) {
    if (isLeftOut(3.0 * frameSeconds_)) return;
    input.prepare(window_.controls());
    if (input.drag == Drag::Light && stage_.radiosity) {
      window_.controls().drag(input.drag, {dragged, 0.0});
      window_.settle(std::min(longestStart, end_.left()));
    }
    Rows rows(name_ + "/" + input.name);
    report(move(input.drag, seconds), rows);
    // With costly pictures, the movement of a light gets more than its share.
    const bool matters = input.drag == Drag::Light;
    if (isCostly(framesOfLatency, matters ? end_.left() : latencyShare * seconds))
      ++leftOut_;
    else
      measureLatency(input.drag, latencyShare * seconds, rows);
    rows.moveTo(run_.results());
  }

  /// Measures frames while something changes, then frames with timed parts and counted uploads.
  Frames measureFrames(double seconds, const std::function<void(int)>& change) {
    Frames frames;
    int done = 0;
    const auto step = [&] {
      run_.check();
      change(done++);
    };
    for (int i = 0; i < framesBeforeTiming && (i < 1 || !isCostly(4.0, seconds)); ++i) {
      step();
      window_.frame(false);
    }
    const int least = isCostly(2.0 * leastFrames, seconds) ? 1 : leastFrames;
    const Deadline timed(framesShare * seconds);
    for (int i = 0; i < options_.frames && (i < least || !timed.isPast()); ++i) {
      step();
      frames.measure([&] { window_.frame(false); });
    }
    const viewer::gl::UploadCounter uploads;
    const Deadline apart(partsShare * seconds);
    for (int i = 0; i < std::max(1, options_.frames / 4) && (i < 1 || !apart.isPast()); ++i) {
      step();
      const std::size_t before = uploads.bytes();
      frames.parts.push_back(window_.timedFrame(false));
      if (viewer::gl::UploadCounter::works())
        frames.uploaded.push_back(static_cast<double>(uploads.bytes() - before));
    }
    return frames;
  }

  Frames move(Drag what, double seconds) {
    return measureFrames(seconds, [&](int i) {
      const double turn = 2.0 * std::numbers::pi * i / std::max(options_.frames, 1);
      window_.controls().drag(what, {dragged, 0.3 * dragged * std::sin(turn)});
    });
  }

  /// Measures the time from an input at rest to the next picture, and to the final picture. Windows begin the
  /// latter when nothing has moved for a while; that pause is not counted.
  void measureLatency(Drag what, double seconds, Rows& rows) {
    const Deadline end(seconds);
    std::vector<double> first, finished;
    bool allFinished = window_.settle(end.left());
    for (int i = 0; i < options_.inputs && (i < 1 || !end.isPast()); ++i) {
      run_.check();
      const double next = secondsOf([&] {
        window_.controls().drag(what, {3.0 * dragged, 0.0});
        window_.frame(false);
      });
      first.push_back(next);
      const double most = std::max(end.left(), seconds / std::max(options_.inputs, 1));
      finished.push_back(next + secondsOf([&] { allFinished = window_.settle(most) && allFinished; }));
    }
    rows.addTime("latency to the next picture", median(first));
    if (allFinished) rows.addTime("latency to the finished picture", median(finished));
    rows.add("inputs timed", static_cast<double>(first.size()), "");
  }

  void measurePlayback(double seconds) {
    if (isLeftOut(3.0 * frameSeconds_) || !window_.play()) return;
    Rows rows(name_ + "/playing");
    report(measureFrames(seconds, [&](int) { window_.controls().playOn(viewer::Playback::frame); }), rows);
    rows.moveTo(run_.results());
  }

  void measureStill(double seconds) {
    if (isLeftOut(4.0 * frameSeconds_)) return;
    const Deadline end(seconds);
    if (!isCostly(8.0, seconds)) window_.settle(seconds);
    Frames still;
    for (int i = 0; i < options_.runs && (i < 1 || !end.isPast()); ++i)
      still.measure([&] { window_.still(); });
    Rows rows(name_ + "/still");
    report(still, rows);
    rows.moveTo(run_.results());
  }

  std::string name_;
  const ViewerOptions& options_;
  SuiteRun& run_;
  WindowStage& stage_;
  HeadlessWindow window_;
  const Deadline& end_;
  double frameSeconds_ = 0.0;  ///< seconds between successive frames
  bool isFirst_ = true;
  int leftOut_ = 0;
};

/// Runs the suite's cases.
class ViewerTrial {
 public:
  ViewerTrial(std::span<const ViewerCase> cases, const Device& device, const ViewerOptions& options,
              SuiteRun& run)
      : cases_(cases),
        device_(device),
        options_(options),
        run_(run),
        steps_(run, "bench viewer", cases.size()),
        shares_(options.suiteSeconds, static_cast<double>(cases.size())) {}

  void measure() {
    for (const ViewerCase& measured : cases_) {
      const Deadline end(shares_.next());
      if (end.isPast())
        ++leftOut_;
      else
        measureCase(measured, end);
      steps_.advance();
    }
    if (leftOut_ > 0)
      run_.results().push_back(
          {"cases", "skipped for lack of time", static_cast<double>(leftOut_), "", {}, {}});
  }

 private:
  void measureCase(const ViewerCase& measured, const Deadline& end) {
    if (scene_.empty() || scene_ != measured.scene) show(measured.scene);
    const WindowSettings settings{measured.width, measured.height, options_.order, options_.rays};
    if (!stage_ || !staged_->sharesStage(measured) || stage_->live) {
      stage_.reset();
      try {
        stage_ = std::make_unique<WindowStage>(*shown_, hasSky_ ? &sky_ : nullptr, measured.shading, settings,
                                               device_, run_);
      } catch (const InputError&) {  // for example light groups in a scene without lights
        run_.results().push_back({measured.name(), "not for this scene", 1.0, "", {}, {}});
        return;
      }
      staged_ = &measured;
    }
    CaseTrial(measured, *stage_, settings, options_, end, run_).measure();
  }

  void show(const std::string& scene) {
    stage_.reset();
    shown_ = loadNamedScene(scene);
    scene_ = scene;
    const bool isFile = sceneName(scene) != scene;
    hasSky_ = isFile ? shown_->scene.lights.empty() : isShownUnderSky(scene);
  }

  std::span<const ViewerCase> cases_;
  const Device& device_;
  const ViewerOptions& options_;
  SuiteRun& run_;
  StepCounter steps_;
  TimeShares shares_;
  const Environment sky_ = makeEveningSky(skyRows);
  std::string scene_;
  std::optional<BenchmarkScene> shown_;
  bool hasSky_ = false;
  std::unique_ptr<WindowStage> stage_;
  const ViewerCase* staged_ = nullptr;
  std::size_t leftOut_ = 0;
};

}  // namespace

bool hasViewerCase(const ViewerOptions& options) { return !viewerCases(options).empty(); }

void runViewer(const Device& device, const ViewerOptions& options, SuiteRun& run) {
  const std::vector<ViewerCase> cases = viewerCases(options);
  if (cases.empty()) refuseViewerCase(options);
  const viewer::gl::EglContext context;
  run.results().push_back({"OpenGL: " + context.rendererName(), "version", context.version(), "", {}, {}});
  ViewerTrial(cases, device, options, run).measure();
}

const OptionTable<ViewerOptions>& ViewerOptions::table() {
  static const OptionTable<ViewerOptions> table =
      OptionTable<ViewerOptions>()
          .add("scenes", &ViewerOptions::scenes, {"shapes", "cornell", "rooms", "swing", "caustics"},
               {"shapes"}, "scenes, built in or files")
          .add("sizes", &ViewerOptions::sizes, {{640, 360}, {1280, 720}}, {{32, 18}, {64, 36}},
               "sizes of the window, pixels", {.most = 8192})
          .add("frames", &ViewerOptions::frames, 30, 3, "largest number of frames of each movement")
          .add("inputs", &ViewerOptions::inputs, 3, 1,
               "largest number of inputs of each kind whose latency is measured")
          .add("order", &ViewerOptions::order, 4, 2, "order of SH", {.most = 32})
          .add("rays", &ViewerOptions::rays, 256, 8, "rays per vertex");
  return table;
}

void ViewerOptions::takeGiven() {
  scenes.insert(scenes.begin(), given.models.begin(), given.models.end());
  if (given.size) sizes = {*given.size};
}

std::unique_ptr<Suite> viewerSuite() {
  SuiteOf<ViewerOptions>::Runners parts = {
      {"viewer", "frame times, latency and uploads of the window, by shading, scene, size and movement",
       runViewer, hasViewerCase},
  };
  return std::make_unique<SuiteOf<ViewerOptions>>("viewer", "frame times, latency and uploads of the window",
                                                  std::move(parts));
}

}  // namespace prelight::benchmarks
