#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <optional>

#include "benchmarks/run/measure.h"
#include "benchmarks/run/timing.h"
#include "benchmarks/suites/live/live_error.h"
#include "benchmarks/suites/live/live_suite.h"
#include "gi/update/live_light.h"

namespace prelight::benchmarks {

namespace {

constexpr int mostRestFrames = 600;
constexpr double settledError = 1e-3;

/// Where a node is after a share of its way, 0 to 1: an eighth of the scene's width and a twentieth of its
/// depth from its first place.
RigidMotion motionOf(const BenchmarkScene& scene, double share) {
  const glm::dvec3 size(scene.compiled.boundsMax - scene.compiled.boundsMin);
  return {glm::dmat3(1.0), share * glm::dvec3(0.12 * size.x, 0.0, 0.05 * size.z)};
}

using Irradiances = std::vector<glm::vec3>;

Irradiances copyOf(std::span<const glm::vec3> values) { return {values.begin(), values.end()}; }

/// Options of the light of a window of 1280 x 720 pixels.
LiveLightOptions windowOptions(const LiveOptions& options) {
  LiveLightOptions live = optionsOfWindows();
  live.photons = options.followingPhotons;
  live.texels = options.followingTexels;
  live.gather.rays = 128;
  live.frameSeconds = options.followingMilliseconds * 1e-3;
  live.clock = [] { return processorSeconds() / 2.0; };
  return live;
}

/// Compares light that follows a node with light computed anew in each frame.
class Following {
 public:
  Following(const BenchmarkScene& scene, const std::string& node, const LiveOptions& options,
            const Device& device, Progress& progress, std::vector<BenchmarkResult>& results)
      : scene_(scene),
        case_(scene.name + ", " + node),
        node_(nodeOf(scene, node)),
        options_(options),
        progress_(progress),
        results_(results),
        live_(scene.scene, scene.compiled, nullptr, 0.0, windowOptions(options), {}, device, progress),
        truth_(scene.scene, scene.compiled, nullptr, 0.0, windowOptions(options), {}, device, progress),
        before_(copyOf(live_.indirect())) {}

  void run() {
    move();
    rest();
    for (const auto& [stage, seconds] : stages_)
      add(stage + ", mean of frames at work", seconds / frames_, "s");
  }

 private:
  void add(const std::string& metric, double value, const char* unit) {
    results_.push_back({case_, metric, value, unit, {}, {}});
  }

  double frame() {
    const double start = processorSeconds();
    const LiveFrame frame = live_.advance(progress_);
    const double seconds = processorSeconds() - start;
    for (const auto& [stage, s] : frame.stageSeconds) stages_[stage] += s;
    ++frames_;
    return seconds;
  }

  Irradiances lightAnew(double share) {
    truth_.moveNode(node_, motionOf(scene_, share));
    truth_.recompute(progress_);
    return copyOf(truth_.indirect());
  }

  void move() {
    std::vector<double> seconds;
    double worst = 0.0, error = 0.0, untouched = 0.0;
    for (int f = 1; f <= options_.followingFrames; ++f) {
      const double share = static_cast<double>(f) / options_.followingFrames;
      live_.moveNode(node_, motionOf(scene_, share));
      seconds.push_back(frame());
      if (f % options_.followingEvery != 0 && f != options_.followingFrames) continue;
      settled_ = lightAnew(share);
      error = relativeError(live_.indirect(), settled_);
      untouched = relativeError(before_, settled_);
      worst = std::max(worst, error / untouched);
      add(fmt::format("frame {}: error", f), error, "of the mean");
      add(fmt::format("frame {}: error, of that of the first light", f), error / untouched, "1");
    }
    add("moving: greatest error, of that of the first light", worst, "1");
    add("moving: processor time of a frame, median", median(seconds), "s");
    add("moving: processor time of a frame, most", *std::max_element(seconds.begin(), seconds.end()), "s");
    add("stop: error of the first light", untouched, "of the mean");
    add("stop: error", error, "of the mean");
    untouched_ = untouched;
  }

  void rest() {
    double work = 0.0, most = 0.0;
    std::optional<double> near;
    int frames = 0, nearFrames = 0;
    while (!live_.settled() && frames < mostRestFrames) {
      const double seconds = frame();
      work += seconds;
      most = std::max(most, seconds);
      ++frames;
      const double error = relativeError(live_.indirect(), settled_);
      if (frames <= 10 || frames % 10 == 0)
        add(fmt::format("{} frames at rest: error, of that of the first light", frames), error / untouched_,
            "1");
      if (error > settledError)
        near.reset();
      else if (!near)
        near = work, nearFrames = frames;
    }
    add("rest: frames to an error of 0.001", near ? nearFrames : -1, "frames");
    add("rest: processor time to an error of 0.001", near.value_or(-1.0), "s");
    add("rest: frames until settled", frames, "frames");
    add("rest: processor time until settled", work, "s");
    add("rest: processor time of a frame, most", most, "s");
    add("settled: error", relativeError(live_.indirect(), settled_), "of the mean");
    const double start = processorSeconds();
    truth_.recompute(progress_);
    add("everything anew: processor time", processorSeconds() - start, "s");
  }

  const BenchmarkScene& scene_;
  std::string case_;
  int node_;
  const LiveOptions& options_;
  Progress& progress_;
  std::vector<BenchmarkResult>& results_;
  LiveLight live_, truth_;
  Irradiances before_, settled_;
  double untouched_ = 0.0;
  std::map<std::string, double> stages_;
  int frames_ = 0;
};

}  // namespace

void runFollowing(const Device& device, const LiveOptions& options, SuiteRun& run) {
  StopOnly quiet(run);
  StepCounter steps(run, "bench following", options.followingScenes.size());
  for (const auto& [name, node] : options.followingScenes) {
    const BenchmarkScene scene = loadBuiltinScene(name);
    Following(scene, node, options, device, quiet, run.results()).run();
    steps.advance();
  }
}

}  // namespace prelight::benchmarks
