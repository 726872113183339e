#include "benchmarks/suites/viewer/viewer_suite.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numbers>
#include <optional>
#include <set>
#include <span>

#include "benchmarks/run/processor_time.h"
#include "benchmarks/run/time_shares.h"
#include "benchmarks/scenes/compared_scenes.h"
#include "benchmarks/suites/viewer/headless_window.h"
#include "benchmarks/suites/viewer/viewer_cases.h"
#include "prelight/error.h"
#include "viewer/gl/egl_context.h"
#include "viewer/gl/timer_query.h"
#include "viewer/gl/uploads.h"

namespace prelight::benchmarks {

namespace {

using viewer::Command;
using viewer::Controls;
using viewer::Drag;
using viewer::Shading;

constexpr double dragged = 0.01;       // window heights a frame
constexpr int framesBeforeTiming = 2;  // what is compiled and made with the first is no frame's cost
constexpr int leastFrames = 3;         // of a movement, where they are not costly
constexpr double longestStart = 20.0;  // s, until light that follows is there: form factors are found once
constexpr int skyRows = 64;

/// Shares of a movement's time: frames that are timed, frames whose parts are timed, and latencies.
constexpr double framesShare = 0.35, partsShare = 0.15, latencyShare = 0.5;

/// Share of a case's time that light may take to settle before anything moves.
constexpr double settleShare = 0.15;

/// Frames that a latency takes at least: all samples of a picture before the input and after it, and the
/// next.
constexpr double framesOfLatency = 9.0;

/// A movement by a user's hand.
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
      [](Controls& controls) { controls.run(Command::NextNode); },  // the first is what the others stand on
      [](const Controls& controls, bool) { return controls.nodesMoveNow(); }}}};

/// Measurements of one movement.
struct Frames {
  std::vector<double> seconds, processor;
  std::vector<double> opengl;    ///< none where the driver counts no time
  std::vector<PartTimes> parts;  ///< parts of further frames
  std::vector<double> uploaded;  ///< bytes of these

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

/// The value that a share of all does not exceed.
double quantile(std::vector<double> values, double share) {
  std::sort(values.begin(), values.end());
  return values[static_cast<std::size_t>(std::ceil(share * static_cast<double>(values.size()))) - 1];
}

/// Rows of the suite's report.
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
  parts.erase("");  // what comes before the first part of a frame
  for (const std::string& part : parts) {
    std::vector<double> values;
    for (const PartTimes& times : frames.parts) values.push_back(times.contains(part) ? times.at(part) : 0.0);
    if (const double typical = median(values); typical > 0.0) rows.add("part: " + part, typical, "ms");
  }
}

/// A case at work: what its time is left for.
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
      rows.add("left out for want of time", leftOut_, "measurements");
      rows.moveTo(run_.results());
    }
  }

 private:
  /// The first movement is always measured, however little time there is.
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
    // Where pictures are costly, the movement of a light is worth more than its share.
    const bool matters = input.drag == Drag::Light;
    if (isCostly(framesOfLatency, matters ? end_.left() : latencyShare * seconds))
      ++leftOut_;
    else
      measureLatency(input.drag, latencyShare * seconds, rows);
    rows.moveTo(run_.results());
  }

  /// Frames while something changes, then some whose parts are timed and whose uploads are counted.
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

  /// From one input, when all has come to rest, to the next picture and to the one that nothing changes any
  /// more. Windows begin the latter when nothing has moved for a while, which is not counted.
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
  double frameSeconds_ = 0.0;  ///< seconds of a frame that follows another
  bool isFirst_ = true;
  int leftOut_ = 0;
};

/// The suite at work.
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
          {"cases", "left out for want of time", static_cast<double>(leftOut_), "", {}, {}});
  }

 private:
  void measureCase(const ViewerCase& measured, const Deadline& end) {
    if (scene_.empty() || scene_ != measured.scene) show(measured.scene);
    const WindowSettings settings{measured.width, measured.height, options_.order, options_.rays};
    if (!stage_ || !staged_->sharesStage(measured) || stage_->live) {
      stage_.reset();
      try {
        stage_.emplace(*shown_, hasSky_ ? &sky_ : nullptr, measured.shading, settings, device_, run_);
      } catch (const InputError&) {  // of groups of lights, for instance, in a scene without any
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
  std::optional<WindowStage> stage_;
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
               "sizes of the window, pixels")
          .add("frames", &ViewerOptions::frames, 30, 3, "frames of each movement at most")
          .add("inputs", &ViewerOptions::inputs, 3, 1,
               "inputs of each kind at most whose latency is measured")
          .add("order", &ViewerOptions::order, 4, 2, "order of SH")
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
