#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numbers>
#include <set>

#include "benchmarks/headless_window.h"
#include "benchmarks/processor_time.h"
#include "benchmarks/suites.h"
#include "viewer/gl/egl_context.h"

namespace prelight::benchmarks {

namespace {

using viewer::Command;
using viewer::Drag;
using viewer::Shading;

constexpr double dragged = 0.01;       // window heights a frame
constexpr int framesBeforeTiming = 2;  // what is compiled and made with the first is no frame's cost

/// Of one movement.
struct Frames {
  std::vector<double> seconds, processor;
  std::vector<PartTimes> parts;  ///< of further frames

  void measure(const std::function<void()>& frame) {
    const double before = processorSeconds();
    seconds.push_back(secondsOf(frame));
    processor.push_back(processorSeconds() - before);
  }
};

/// The value that a share of all does not exceed.
double quantile(std::vector<double> values, double share) {
  std::sort(values.begin(), values.end());
  return values[static_cast<std::size_t>(std::ceil(share * static_cast<double>(values.size()))) - 1];
}

void report(const std::string& case_, const Frames& frames, std::vector<BenchmarkResult>& results) {
  const auto add = [&](const std::string& metric, double milliseconds) {
    results.push_back({"window", case_, metric, milliseconds, "ms", {}, {}});
  };
  add("median frame", 1e3 * median(frames.seconds));
  add("least frame", 1e3 * quantile(frames.seconds, 0.0 + 1.0 / static_cast<double>(frames.seconds.size())));
  add("95th percentile", 1e3 * quantile(frames.seconds, 0.95));
  add("processor time", 1e3 * median(frames.processor));
  std::set<std::string> parts;
  for (const PartTimes& times : frames.parts)
    for (const auto& [part, milliseconds] : times) parts.insert(part);
  for (const std::string& part : parts) {
    std::vector<double> values;
    for (const PartTimes& times : frames.parts) values.push_back(times.contains(part) ? times.at(part) : 0.0);
    if (const double typical = median(values); typical > 0.0) add("part: " + part, typical);
  }
}

struct Case {
  const char* scene;
  Shading shading;

  std::string name() const { return fmt::format("{}/{}", scene, viewer::shadingName(shading)); }
};

constexpr std::array<Case, 14> cases = {{{"shapes", Shading::Sh},
                                         {"cornell", Shading::Sh},
                                         {"rooms", Shading::GlobalIllumination},
                                         {"shapes", Shading::Phong},
                                         {"rooms", Shading::Phong},
                                         {"shapes", Shading::Ao},
                                         {"cornell", Shading::Lights},
                                         {"cornell", Shading::LightMap},
                                         {"rooms", Shading::LightMap},
                                         {"cornell", Shading::Vo},
                                         {"caustics", Shading::GlobalIllumination},
                                         {"swing", Shading::Sh},
                                         {"swing", Shading::Vo},
                                         {"shapes", Shading::Vo}}};

/// Frames while something changes, then some whose parts are timed.
Frames measureFrames(HeadlessWindow& window, int count, const Progress& progress,
                     const std::function<void(int)>& change) {
  Frames frames;
  const int all = framesBeforeTiming + count + std::max(1, count / 4);
  for (int i = 0; i < all; ++i) {
    progress.check();
    change(i);
    if (i < framesBeforeTiming)
      window.frame(false);
    else if (i < framesBeforeTiming + count)
      frames.measure([&] { window.frame(false); });
    else
      frames.parts.push_back(window.timedFrame(false));
  }
  return frames;
}

Frames move(HeadlessWindow& window, Drag what, int count, const Progress& progress) {
  return measureFrames(window, count, progress, [&](int i) {
    const double turn = 2.0 * std::numbers::pi * i / std::max(count, 1);
    window.controls().drag(what, {dragged, 0.3 * dragged * std::sin(turn)});
  });
}

void measureCase(const Case& chosen, const Device& device, const BenchmarkOptions& options,
                 const Progress& progress, std::vector<BenchmarkResult>& results) {
  const WindowSettings settings{options.windowWidth, options.windowHeight, options.windowOrder,
                                options.windowRays};
  WindowStage stage(chosen.scene, chosen.shading, settings, device, progress);
  HeadlessWindow window(stage, chosen.shading, settings);
  window.settle();
  const std::string name = chosen.name();
  report(name + "/orbit", move(window, Drag::Orbit, options.windowFrames, progress), results);
  window.controls().run(Command::ResetView);
  if (window.controls().selectedLight() < 0) window.controls().run(Command::AddLight);
  report(name + "/moving light", move(window, Drag::Light, options.windowFrames, progress), results);
  if (chosen.shading == Shading::Vo) {
    window.controls().run(Command::NextNode);  // the first is what the others stand on
    report(name + "/moving node", move(window, Drag::Node, options.windowFrames, progress), results);
  }
  if (window.play())
    report(name + "/playing",
           measureFrames(window, options.windowFrames, progress,
                         [&](int) { window.controls().playOn(viewer::Playback::frame); }),
           results);
  window.settle();
  Frames still;
  for (int run = 0; run < options.runs; ++run) still.measure([&] { window.still(); });
  report(name + "/still", still, results);
}

std::vector<Case> chosenCases(const BenchmarkOptions& options) {
  std::vector<Case> chosen;
  std::copy_if(cases.begin(), cases.end(), std::back_inserter(chosen),
               [&](const Case& some) { return some.name().find(options.onlyCase) != std::string::npos; });
  return chosen;
}

}  // namespace

bool hasWindowCase(const BenchmarkOptions& options) { return !chosenCases(options).empty(); }

std::vector<BenchmarkResult> runWindowSuite(const Device& device, const BenchmarkOptions& options,
                                            Progress& progress) {
  const std::vector<Case> wanted = chosenCases(options);
  if (wanted.empty()) {
    std::string names;
    for (const Case& some : cases) names += (names.empty() ? "" : ", ") + some.name();
    throw UsageError("--case " + options.onlyCase, "no case of `window` has such a name",
                     "they are " + names);
  }
  const viewer::gl::EglContext context;
  StepCounter steps(progress, "bench window", wanted.size());
  std::vector<BenchmarkResult> results;
  for (const Case& chosen : wanted) {
    measureCase(chosen, device, options, progress, results);
    steps.advance();
  }
  return results;
}

}  // namespace prelight::benchmarks
