#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <functional>
#include <numbers>
#include <optional>
#include <set>
#include <span>

#include "benchmarks/compared_scenes.h"
#include "benchmarks/headless_window.h"
#include "benchmarks/processor_time.h"
#include "benchmarks/suites.h"
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
constexpr int leastFrames = 3;         // of a movement, however slow
constexpr double longestStart = 20.0;  // s, until light that follows is there: form factors are found once
constexpr int skyRows = 64;

/// Of a case's time, the shares of frames that are timed, of those whose parts are, of latencies; movements
/// share them.
constexpr double framesShare = 0.35, partsShare = 0.15, latencyShare = 0.4;
constexpr int mostMovements = 5;  // the pictures of a view that stands still take the rest

/// What a scene is lit by when it is shown.
struct ShownScene {
  const char* name;
  bool hasSky;
};

constexpr std::array<ShownScene, 5> shownScenes = {
    {{"shapes", true}, {"cornell", false}, {"rooms", false}, {"swing", true}, {"caustics", false}}};

struct Case {
  ShownScene scene;
  Shading shading;
  int width;
  int height;

  std::string name() const {
    return fmt::format("{}/{}/{}x{}", scene.name, viewer::shadingName(shading), width, height);
  }
};

/// What a user's hand does.
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

/// Of one movement.
struct Frames {
  std::vector<double> seconds, processor, opengl;
  std::vector<PartTimes> parts;  ///< of further frames
  std::vector<double> uploaded;  ///< bytes of these

  void measure(const std::function<void()>& frame) {
    const viewer::gl::TimerQuery query;
    const double before = processorSeconds();
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
    rows_.push_back({"viewer", case_, metric, value, unit, {}, {}});
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
  rows.addTime("OpenGL's timer", median(frames.opengl));
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

/// Time that something may take; what is slow is done less often.
class Budget {
 public:
  explicit Budget(double seconds)
      : end_(Clock::now() +
             std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(seconds))) {}
  bool isSpent() const { return Clock::now() >= end_; }
  double left() const { return std::max(0.0, std::chrono::duration<double>(end_ - Clock::now()).count()); }

 private:
  using Clock = std::chrono::steady_clock;
  Clock::time_point end_;
};

/// How much of a case is measured.
struct Amount {
  int frames = 0;        ///< of each movement at most
  int inputs = 0;        ///< whose latency is measured, at most
  double seconds = 0.0;  ///< of a movement, about
};

/// Frames while something changes, then some whose parts are timed and whose uploads are counted.
Frames measureFrames(HeadlessWindow& window, const Amount& amount, const Progress& progress,
                     const std::function<void(int)>& change) {
  Frames frames;
  const auto step = [&](int i) {
    progress.check();
    change(i);
  };
  for (int i = 0; i < framesBeforeTiming; ++i) {
    step(i);
    window.frame(false);
  }
  int done = framesBeforeTiming;
  const Budget timed(framesShare * amount.seconds);
  for (int i = 0; i < amount.frames && (i < leastFrames || !timed.isSpent()); ++i) {
    step(done++);
    frames.measure([&] { window.frame(false); });
  }
  const viewer::gl::UploadCounter uploads;
  const Budget apart(partsShare * amount.seconds);
  for (int i = 0; i < std::max(1, amount.frames / 4) && (i < 1 || !apart.isSpent()); ++i) {
    step(done++);
    const std::size_t before = uploads.bytes();
    frames.parts.push_back(window.timedFrame(false));
    if (viewer::gl::UploadCounter::works())
      frames.uploaded.push_back(static_cast<double>(uploads.bytes() - before));
  }
  return frames;
}

Frames move(HeadlessWindow& window, Drag what, const Amount& amount, const Progress& progress) {
  return measureFrames(window, amount, progress, [&](int i) {
    const double turn = 2.0 * std::numbers::pi * i / std::max(amount.frames, 1);
    window.controls().drag(what, {dragged, 0.3 * dragged * std::sin(turn)});
  });
}

/// From one input, when all has come to rest, to the next picture and to the one that nothing changes any
/// more. Windows begin the latter when nothing has moved for a while, which is not counted.
void measureLatency(HeadlessWindow& window, Drag what, const Amount& amount, const Progress& progress,
                    Rows& rows) {
  const Budget budget(latencyShare * amount.seconds);
  std::vector<double> first, finished;
  bool allFinished = window.settle(budget.left());
  for (int i = 0; i < amount.inputs && (i < 1 || !budget.isSpent()); ++i) {
    progress.check();
    const double next = secondsOf([&] {
      window.controls().drag(what, {3.0 * dragged, 0.0});
      window.frame(false);
    });
    first.push_back(next);
    const double most = std::max(budget.left(), latencyShare * amount.seconds / std::max(amount.inputs, 1));
    finished.push_back(next + secondsOf([&] { allFinished = window.settle(most) && allFinished; }));
  }
  rows.addTime("latency to the next picture", median(first));
  if (allFinished) rows.addTime("latency to the finished picture", median(finished));
}

void measureStill(HeadlessWindow& window, int runs, double seconds, const std::string& name,
                  std::vector<BenchmarkResult>& results) {
  const Budget budget(seconds);
  window.settle(seconds);
  Frames still;
  for (int run = 0; run < runs && (run < 1 || !budget.isSpent()); ++run)
    still.measure([&] { window.still(); });
  Rows rows(name + "/still");
  report(still, rows);
  rows.moveTo(results);
}

void measureCase(const Case& chosen, WindowStage& stage, const WindowSettings& settings,
                 const BenchmarkOptions& options, const Progress& progress,
                 std::vector<BenchmarkResult>& results) {
  const Amount amount{options.viewerFrames, options.viewerInputs, options.viewerSeconds / mostMovements};
  HeadlessWindow window(stage, chosen.shading, settings);
  window.settle(amount.seconds);
  for (const Input& input : inputs) {
    if (!input.fits(window.controls(), chosen.scene.hasSky)) continue;
    input.prepare(window.controls());
    if (input.drag == Drag::Light && stage.radiosity) {
      window.controls().drag(input.drag, {dragged, 0.0});
      window.settle(longestStart);
    }
    Rows rows(chosen.name() + "/" + input.name);
    report(move(window, input.drag, amount, progress), rows);
    measureLatency(window, input.drag, amount, progress, rows);
    rows.moveTo(results);
  }
  if (window.play()) {
    Rows rows(chosen.name() + "/playing");
    report(measureFrames(window, amount, progress,
                         [&](int) { window.controls().playOn(viewer::Playback::frame); }),
           rows);
    rows.moveTo(results);
  }
  measureStill(window, options.runs, amount.seconds, chosen.name(), results);
}

/// The cases of a scene and a shading, by size.
void measureSizes(std::span<const Case> cases, const Device& device, const BenchmarkOptions& options,
                  const Progress& progress, StepCounter& steps, std::vector<BenchmarkResult>& results) {
  const ShownScene& scene = cases.front().scene;
  const Environment sky = makeEveningSky(skyRows);
  std::optional<WindowStage> stage;
  for (const Case& chosen : cases) {
    const WindowSettings settings{chosen.width, chosen.height, options.viewerOrder, options.viewerRays};
    if (!stage || stage->live)
      stage.emplace(StageLook{scene.name, scene.hasSky ? &sky : nullptr}, chosen.shading, settings, device,
                    progress);
    measureCase(chosen, *stage, settings, options, progress, results);
    steps.advance();
  }
}

/// Every shading on every scene that is asked for, or of all scenes what `--case` names.
std::vector<Case> chosenCases(const BenchmarkOptions& options) {
  std::vector<Case> chosen;
  const auto& names = options.viewerScenes;
  for (const ShownScene& scene : shownScenes) {
    if (options.onlyCase.empty() && std::find(names.begin(), names.end(), scene.name) == names.end())
      continue;
    for (const viewer::ShadingInfo& shading : viewer::shadings())
      for (const auto& [width, height] : options.viewerSizes) {
        const Case some{scene, shading.shading, width, height};
        if (some.name().find(options.onlyCase) != std::string::npos) chosen.push_back(some);
      }
  }
  return chosen;
}

}  // namespace

bool hasViewerCase(const BenchmarkOptions& options) { return !chosenCases(options).empty(); }

std::vector<BenchmarkResult> runViewerSuite(const Device& device, const BenchmarkOptions& options,
                                            Progress& progress) {
  const std::vector<Case> wanted = chosenCases(options);
  if (wanted.empty()) {
    std::string scenes;
    for (const ShownScene& scene : shownScenes) scenes += fmt::format(" {}", scene.name);
    throw UsageError("--case " + options.onlyCase, "no case of `viewer` has such a name",
                     fmt::format("they are SCENE/SHADING/WIDTHxHEIGHT, scenes{}; shadings {}", scenes,
                                 viewer::shadingNames()));
  }
  const viewer::gl::EglContext context;
  StepCounter steps(progress, "bench viewer", wanted.size());
  std::vector<BenchmarkResult> results;
  results.push_back(
      {"viewer", "OpenGL: " + context.rendererName(), "version", context.version(), "", {}, {}});
  for (auto begin = wanted.begin(); begin != wanted.end();) {
    const auto end = std::find_if(begin, wanted.end(), [&](const Case& some) {
      return std::string_view(some.scene.name) != begin->scene.name || some.shading != begin->shading;
    });
    measureSizes({begin, end}, device, options, progress, steps, results);
    begin = end;
  }
  return results;
}

}  // namespace prelight::benchmarks
