#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numbers>
#include <set>

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
constexpr int skyRows = 64;

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

/// Frames while something changes, then some whose parts are timed and whose uploads are counted.
Frames measureFrames(HeadlessWindow& window, int count, const Progress& progress,
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
  for (int i = 0; i < count; ++i) {
    step(framesBeforeTiming + i);
    frames.measure([&] { window.frame(false); });
  }
  const viewer::gl::UploadCounter uploads;
  for (int i = 0; i < std::max(1, count / 4); ++i) {
    step(framesBeforeTiming + count + i);
    const std::size_t before = uploads.bytes();
    frames.parts.push_back(window.timedFrame(false));
    if (viewer::gl::UploadCounter::works())
      frames.uploaded.push_back(static_cast<double>(uploads.bytes() - before));
  }
  return frames;
}

Frames move(HeadlessWindow& window, Drag what, int count, const Progress& progress) {
  return measureFrames(window, count, progress, [&](int i) {
    const double turn = 2.0 * std::numbers::pi * i / std::max(count, 1);
    window.controls().drag(what, {dragged, 0.3 * dragged * std::sin(turn)});
  });
}

/// From one input, when all has come to rest, to the next picture and to the one that nothing changes any
/// more. Windows begin the latter when nothing has moved for a while, which is not counted.
void measureLatency(HeadlessWindow& window, Drag what, int count, const Progress& progress, Rows& rows) {
  std::vector<double> first, finished;
  bool allFinished = window.settle();
  for (int i = 0; i < count; ++i) {
    progress.check();
    const double next = secondsOf([&] {
      window.controls().drag(what, {3.0 * dragged, 0.0});
      window.frame(false);
    });
    first.push_back(next);
    finished.push_back(next + secondsOf([&] { allFinished = window.settle() && allFinished; }));
  }
  rows.addTime("latency to the next picture", median(first));
  if (allFinished) rows.addTime("latency to the finished picture", median(finished));
}

void measureCase(const Case& chosen, const Device& device, const BenchmarkOptions& options,
                 const Progress& progress, std::vector<BenchmarkResult>& results) {
  const WindowSettings settings{chosen.width, chosen.height, options.viewerOrder, options.viewerRays};
  const Environment sky = makeEveningSky(skyRows);
  const Environment* shownSky = chosen.scene.hasSky ? &sky : nullptr;
  WindowStage stage({chosen.scene.name, shownSky}, chosen.shading, settings, device, progress);
  HeadlessWindow window(stage, chosen.shading, settings);
  window.settle();
  for (const Input& input : inputs) {
    if (!input.fits(window.controls(), chosen.scene.hasSky)) continue;
    input.prepare(window.controls());
    Rows rows(chosen.name() + "/" + input.name);
    report(move(window, input.drag, options.viewerFrames, progress), rows);
    measureLatency(window, input.drag, options.viewerInputs, progress, rows);
    rows.moveTo(results);
  }
  if (window.play()) {
    Rows rows(chosen.name() + "/playing");
    report(measureFrames(window, options.viewerFrames, progress,
                         [&](int) { window.controls().playOn(viewer::Playback::frame); }),
           rows);
    rows.moveTo(results);
  }
  window.settle();
  Frames still;
  for (int run = 0; run < options.runs; ++run) still.measure([&] { window.still(); });
  Rows rows(chosen.name() + "/still");
  report(still, rows);
  rows.moveTo(results);
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
  for (const Case& chosen : wanted) {
    measureCase(chosen, device, options, progress, results);
    steps.advance();
  }
  return results;
}

}  // namespace prelight::benchmarks
