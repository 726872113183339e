#include <fmt/format.h>

#include <array>
#include <cmath>
#include <optional>
#include <utility>

#include "benchmarks/run/measure.h"
#include "benchmarks/run/timing.h"
#include "benchmarks/suites/indirect/indirect_suite.h"
#include "charts/make_light_map_layout.h"
#include "charts/wall_search.h"
#include "gi/indirect_light.h"
#include "gpu/light_tables.h"
#include "prelight/picture.h"

namespace prelight::benchmarks {

namespace {

constexpr std::array<std::pair<const char*, GatherChoice>, 3> choices = {
    {{"all", GatherChoice::All}, {"cache", GatherChoice::Cache}, {"guided", GatherChoice::Guided}}};
constexpr std::uint64_t truthSeed = 1000;

/// Largest share of a scene's time that its truth takes.
constexpr double truthShare = 0.35;

using Irradiance = std::vector<glm::vec3>;

double meanOf(const glm::dvec3& v) { return (v.x + v.y + v.z) / 3.0; }

/// Returns the seconds at which a curve of seconds (x) and errors (y) reaches an error, by power laws between
/// its points; nothing beyond its ends.
std::optional<double> secondsTo(double error, const std::vector<Point>& curve) {
  for (std::size_t i = 0; i + 1 < curve.size(); ++i) {
    const Point a = curve[i], b = curve[i + 1];
    if (!(a.y >= error && error >= b.y && a.y > b.y && b.y > 0.0)) continue;
    const double along = std::log(a.y / error) / std::log(a.y / b.y);
    return a.x * std::pow(b.x / a.x, along);
  }
  return std::nullopt;
}

/// Indirect light at the texels of a map, always from the same photons.
class GatherTrial {
 public:
  GatherTrial(const BenchmarkScene& scene, const IndirectOptions& options, const Device& device,
              SuiteRun& run)
      : scene_(scene),
        options_(options),
        device_(device),
        run_(run),
        quiet_(run),
        lit_{scene_.compiled, scene_.scene.images, scene_.scene.lights},
        surface_(makeDensitySurface(
            scene.compiled, makeSurfaceRegions(scene.compiled, LightMapLayoutRequest{}.creaseAngle))) {
    LightMapLayoutRequest map;
    map.texels = options.gatherTexels;
    layout_ = makeLightMapLayout(scene.scene, scene.compiled, map);
    const bool dark = makeLightTables(scene.compiled, scene.scene.lights, nullptr, true).groupCount == 0;
    if (dark) lit_.sky = &white_;
    transport_.emplace(lit_, device);
    findWalls(scene.compiled, transport_->tracer(), layout_);
    patches_.emplace(scene.compiled, transport_->tracer(), layout_, surface_);
    sent_ = sendPhotons(scene.compiled, *transport_, indirectPhotons(*transport_, {}), quiet_);
  }

  struct Found {
    Irradiance irradiance;
    double seconds = 0.0;  ///< processor time
    std::uint64_t rays = 0;
    std::size_t records = 0;
  };

  Found gather(GatherChoice choice, std::uint32_t rays, std::uint64_t seed) {
    IndirectRequest request;
    request.gather = choice;
    request.rays = rays;
    request.gatherSeed = seed;
    IndirectLight light(lit_, *transport_, *patches_, surface_, request, device_, sent_);
    Found found;
    const std::uint64_t before = light.rays();
    const double start = processorSeconds();
    found.irradiance = light.gather(layout_.texels, quiet_);
    found.seconds = processorSeconds() - start;
    found.rays = light.rays() - before;
    found.records = light.records();
    return found;
  }

  /// Finds two independent truths, so that their noise is no part of an error, within `seconds` but with at
  /// least one run each.
  void findTruths(double seconds) {
    const Deadline end(seconds);
    for (std::vector<glm::dvec3>& truth : truths_) truth.assign(layout_.texels.size(), glm::dvec3(0.0));
    int runs = 0;
    for (; runs < options_.gatherTruthRuns && (runs == 0 || !end.isPast()); ++runs)
      for (std::size_t half = 0; half < truths_.size(); ++half) {
        const auto seed = truthSeed + 2 * static_cast<std::uint64_t>(runs) + half;
        const Found found = gather(GatherChoice::All, 2 * options_.gatherLongRun, seed);
        for (std::size_t i = 0; i < found.irradiance.size(); ++i)
          truths_[half][i] += glm::dvec3(found.irradiance[i]);
      }
    for (std::vector<glm::dvec3>& truth : truths_)
      for (glm::dvec3& texel : truth) texel /= static_cast<double>(runs);
    run_.results().push_back(
        {scene_.name + "/truth", "rays", 4.0 * options_.gatherLongRun * runs, "a texel", {}, {}});
  }

  /// Measures a point of a choice's curve, with as many runs as `seconds` allow.
  void measure(const char* name, GatherChoice choice, std::uint32_t rays, double seconds) {
    const Deadline end(seconds);
    std::vector<double> times, squares;
    Found last;
    for (int i = 0; i < options_.runs && (i == 0 || !end.isPast()); ++i) {
      last = gather(choice, rays, static_cast<std::uint64_t>(i) + 1);
      times.push_back(last.seconds);
      squares.push_back(differenceOf(last.irradiance, last.irradiance).square);
    }
    double square = 0.0;
    for (const double one : squares) square += one / static_cast<double>(squares.size());
    const Point point{median(times), std::sqrt(std::max(square, 0.0))};
    const std::string label = fmt::format("{}/{}/{} rays", scene_.name, name, rays);
    add(label, "error", point.y, "of the mean");
    BenchmarkResult time{label, "time", point.x, "s", {}, {}};
    if (choice == GatherChoice::All) {
      allCurve_.push_back(point);
    } else if (const auto peer = secondsTo(point.y, allCurve_)) {
      time.peer = "all, to the same error";
      time.ratio = *peer / point.x;
    }
    run_.results().push_back(std::move(time));
    add(label, "rays", static_cast<double>(last.rays), "");
    add(label, "gathered at", static_cast<double>(last.records), "texels");
    add(label, "runs", static_cast<double>(times.size()), "");
  }

  /// Adds the bias, the error that remains with many rays. Products of the differences of two runs from two
  /// truths have the square of the bias as their mean, without noise.
  void measureBias(const char* name, GatherChoice choice) {
    const Found a = gather(choice, options_.gatherLongRun, truthSeed / 2);
    const Found b = gather(choice, options_.gatherLongRun, truthSeed / 2 + 1);
    const Difference bias = differenceOf(a.irradiance, b.irradiance);
    const std::string label = fmt::format("{}/{}/long run", scene_.name, name);
    const double rms = std::sqrt(std::max(bias.square, 0.0));
    add(label, "bias", rms, "of the mean");
    // The slope of the root, or, if noise hides the square, the root of its uncertainty.
    add(label, "standard error of bias",
        std::min(bias.doubt / std::max(2.0 * rms, 1e-30), std::sqrt(bias.doubt)), "of the mean");
    add(label, "bias of the mean", bias.mean, "of the mean");
  }

 private:
  void add(const std::string& label, const char* metric, double value, const char* unit) {
    run_.results().push_back({label, metric, value, unit, {}, {}});
  }

  /// Differences over lit texels, as shares of the mean of the truths.
  struct Difference {
    double square = 0.0;  ///< mean of (first - one truth) (second - the other)
    double doubt = 0.0;   ///< standard error of `square`
    double mean = 0.0;    ///< mean of the differences
  };

  Difference differenceOf(const Irradiance& first, const Irradiance& second) const {
    double sum = 0.0, squares = 0.0, off = 0.0, light = 0.0, count = 0.0;
    for (std::size_t i = 0; i < first.size(); ++i) {
      const glm::dvec3 truth = 0.5 * (truths_[0][i] + truths_[1][i]);
      if (truth == glm::dvec3(0.0)) continue;  // inside an object
      const double product =
          meanOf((glm::dvec3(first[i]) - truths_[0][i]) * (glm::dvec3(second[i]) - truths_[1][i]));
      sum += product;
      squares += product * product;
      off += meanOf(0.5 * (glm::dvec3(first[i]) + glm::dvec3(second[i])) - truth);
      light += meanOf(truth);
      ++count;
    }
    if (!(light > 0.0)) return {};
    const double scale = std::pow(light / count, 2), mean = sum / count;
    return {mean / scale, std::sqrt(std::max(squares / count - mean * mean, 0.0) / count) / scale,
            off / light};
  }

 private:
  const BenchmarkScene& scene_;
  const IndirectOptions& options_;
  const Device& device_;
  SuiteRun& run_;
  StopOnly quiet_;
  LitScene lit_;
  Environment white_ = constantEnvironment(glm::vec3(1.0f));
  DensitySurface surface_;
  LightMapLayout layout_;
  std::optional<TransportScene> transport_;
  std::optional<SurfacePatches> patches_;  ///< patches of layout_
  SentPhotons sent_;
  std::array<std::vector<glm::dvec3>, 2> truths_;
  std::vector<Point> allCurve_;  ///< seconds and errors of GatherChoice::All
};

/// Returns the sum of weights of a scene's measurements: points by their rays, and two long runs per choice.
double weightsOf(const IndirectOptions& options) {
  double rays = 2.0 * options.gatherLongRun;
  for (const std::uint32_t some : options.gatherRays) rays += some;
  return static_cast<double>(choices.size()) * rays;
}

void measureScene(const BenchmarkScene& scene, double seconds, const Device& device,
                  const IndirectOptions& options, SuiteRun& run, StepCounter& steps) {
  const Deadline end(seconds);
  GatherTrial trial(scene, options, device, run);
  trial.findTruths(truthShare * seconds);
  steps.advance();
  TimeShares shares(end.left(), weightsOf(options));
  for (const auto& [label, choice] : choices) {
    trial.gather(choice, options.gatherRays.front(), 0);  // warms up
    for (const std::uint32_t rays : options.gatherRays) {
      trial.measure(label, choice, rays, shares.next(rays));
      steps.advance();
    }
    shares.next(2.0 * options.gatherLongRun);
    trial.measureBias(label, choice);
    steps.advance();
  }
}

}  // namespace

void runGather(const Device& device, const IndirectOptions& options, SuiteRun& run) {
  const std::size_t parts = 1 + choices.size() * (options.gatherRays.size() + 1);
  StepCounter steps(run, "bench gather", options.gatherScenes.size() * parts);
  TimeShares shares(options.suiteSeconds, static_cast<double>(options.gatherScenes.size()));
  for (const std::string& name : options.gatherScenes) {
    const double seconds = shares.next();
    measureScene(loadNamedScene(name), seconds, device, options, run, steps);
  }
}

}  // namespace prelight::benchmarks
