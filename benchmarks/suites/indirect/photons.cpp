#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <ctime>
#include <numbers>
#include <optional>

#include "benchmarks/lab/photon_grid.h"
#include "benchmarks/lab/progressive_irradiance.h"
#include "benchmarks/run/measure.h"
#include "benchmarks/run/timing.h"
#include "benchmarks/suites/indirect/caustics.h"
#include "benchmarks/suites/indirect/indirect_suite.h"

namespace prelight::benchmarks {

namespace {

using device::DensityQuery;
using device::Photon;

using std::numbers::pi;
constexpr double anywhere = 10.0;  // radius that includes all photons, m
constexpr int compared = 50;       // photons per look-up of trees and grids
const char* const photonPeer = "Larsen 2004";

std::string sizeName(std::uint64_t count) {
  return count >= 1000000 ? fmt::format("{}M", count / 1000000) : fmt::format("{}", count);
}

/// Measurements of one set of photons.
class PhotonTrial {
 public:
  PhotonTrial(DensitySurface surface, std::vector<Photon> photons, const Device& device)
      : surface_(std::move(surface)), photons_(std::move(photons)), device_(device) {}

  const std::vector<Photon>& photons() const { return photons_; }

  /// Returns the median seconds to sort the photons into maps.
  double buildSeconds(int runs) {
    std::vector<double> seconds;
    for (int run = 0; run < runs; ++run)
      seconds.push_back(secondsOf([&] { maps_ = makePhotonMaps(photons_, surface_); }));
    return median(seconds);
  }

  /// Returns the median processor time of a look-up, s, at evenly chosen photons. Call it after
  /// buildSeconds().
  double lookupSeconds(int nearest, std::size_t lookups, int runs) {
    DensityEstimator estimator(surface_, {.kernel = DensityKernel::Constant, .nearest = nearest}, device_);
    estimator.setPhotons(maps_);
    const std::vector<DensityQuery> queries = queriesAtPhotons(photons_, lookups, anywhere);
    const Buffer<DensityQuery> in(device_.context(), std::span<const DensityQuery>(queries));
    Buffer<float> out(device_.context(), 3 * lookups);
    std::vector<Contender> alone{{"trees", [&](std::size_t) {
                                    estimator.estimate(in, lookups, out);
                                    device_.context().finish();
                                  }}};
    StopNever never;
    takeTurns(alone, 1, runs, never);
    return medianSeconds(alone[0].cpuSeconds, 1) / static_cast<double>(lookups);
  }

 private:
  class StopNever final : public Progress {
   public:
    bool stopRequested() const override { return false; }
  };

  DensitySurface surface_;
  std::vector<Photon> photons_;
  const Device& device_;
  PhotonMaps maps_;
};

/// Comparison of trees and grids of the same photons: building, and a look-up at each photon.
class TreesAgainstGrids {
 public:
  TreesAgainstGrids(std::size_t count, bool spot, int nearest, const Device& device,
                    const IndirectOptions& options)
      : name_(fmt::format("{} {}/{}", spot ? "spot" : "even", sizeName(count),
                          nearest > 0 ? "nearest" : "radius")),
        nearest_(nearest),
        device_(device.context()),
        surface_(surfaceOfSquare()),
        tree_(surface_, {.nearest = nearest}, device),
        grid_(surface_, nearest, device),
        options_(options),
        out_(device_, 3 * options.photonLookups) {
    std::mt19937 random(1);
    photons_ = photonsOnSquare(count, spot, random);
    radius_ = nearest > 0 ? anywhere : std::sqrt(compared / (pi * static_cast<double>(count)));
    queries_ = Buffer<DensityQuery>(
        device_, std::span<const DensityQuery>(queriesAtPhotons(photons_, options.photonLookups, radius_)));
  }

  void run(const Progress& progress, std::vector<BenchmarkResult>& results) {
    std::vector<Contender> builds{
        {"trees", [&](std::size_t) { tree_.setPhotons(makePhotonMaps(photons_, surface_)); }},
        {"grids", [&](std::size_t) { buildGrid(); }}};
    takeTurns(builds, 1, options_.runs, progress);
    add("build", builds, 1.0, results);
    std::vector<Contender> lookups{{"trees", [&](std::size_t) { lookUp(tree_); }},
                                   {"grids", [&](std::size_t) { lookUp(grid_); }}};
    takeTurns(lookups, 1, options_.runs, progress);
    add("look-up", lookups, static_cast<double>(options_.photonLookups), results);
    results.push_back({name_, "difference", difference(), "1", {}, {}});
  }

 private:
  static DensitySurface surfaceOfSquare() {
    const CompiledScene scene = makeSquares(1);
    return makeDensitySurface(scene, wholeRegion(scene));
  }

  void buildGrid() { grid_.setPhotons(photons_, 8.0, nearest_ > 0 ? 0.0 : 2.0 * radius_); }

  template <typename Estimator>
  void lookUp(Estimator& estimator) {
    estimator.estimate(queries_, options_.photonLookups, out_);
    device_.finish();
  }

  /// Returns the largest relative difference of the two.
  double difference() {
    lookUp(tree_);
    const std::vector<float> one = out_.read();
    lookUp(grid_);
    const std::vector<float> other = out_.read();
    double most = 0.0;
    for (std::size_t i = 0; i < one.size(); ++i)
      most = std::max(most, std::abs(static_cast<double>(one[i] - other[i])) /
                                std::max(static_cast<double>(one[i]), 1e-30));
    return most;
  }

  void add(const char* metric, const std::vector<Contender>& pair, double share,
           std::vector<BenchmarkResult>& results) {
    results.push_back({name_, metric, medianSeconds(pair[0].cpuSeconds, 1) / share, "s", "grid",
                       medianRatio(pair[0].cpuSeconds, pair[1].cpuSeconds)});
  }

  std::string name_;
  int nearest_;
  DeviceContext& device_;
  DensitySurface surface_;
  DensityEstimator tree_;
  PhotonGridEstimator grid_;
  const IndirectOptions& options_;
  double radius_ = 0.0;
  std::vector<Photon> photons_;
  Buffer<DensityQuery> queries_;
  Buffer<float> out_;
};

void addBeside(const std::string& name, const char* metric, double seconds, std::optional<double> then,
               std::vector<BenchmarkResult>& results) {
  if (then)
    results.push_back({name, metric, seconds, "s", photonPeer, *then / seconds});
  else
    results.push_back({name, metric, seconds, "s", {}, {}});
}

/// Measures Table 8.1: a number of photons in growing numbers of maps.
void measureMaps(const Device& device, const IndirectOptions& options,
                 std::vector<BenchmarkResult>& results) {
  constexpr std::array<double, 4> builds = {5.05, 3.08, 0.70, 0.55},
                                  lookups = {332e-6, 291e-6, 213e-6, 116e-6};
  std::size_t maps = 1;
  for (std::size_t row = 0; row < builds.size(); ++row, maps *= 10) {
    const CompiledScene scene = makeSquares(maps);
    std::mt19937 random(1);
    PhotonTrial trial(makeDensitySurface(scene, makeSurfaceRegions(scene, usualCreaseAngle)),
                      photonsInCube(options.photonCount, maps, random), device);
    const bool same = options.photonCount == 1000000;
    const std::string name = fmt::format("table 8.1/{} maps", maps);
    addBeside(name, "build", trial.buildSeconds(options.runs),
              same ? std::optional(builds[row]) : std::nullopt, results);
    const double lookup = trial.lookupSeconds(500, options.photonLookups, options.runs);
    addBeside(name, "look-up of 500", lookup, same ? std::optional(lookups[row]) : std::nullopt, results);
  }
}

/// Measures Table 8.2: one map per scene or per region, and an estimate at every photon.
void measurePhotons(const Device& device, const IndirectOptions& options,
                    std::vector<BenchmarkResult>& results) {
  const CompiledScene scene = loadBuiltinScene("rooms").compiled;
  for (const bool several : {false, true}) {
    std::mt19937 random(1);
    const std::size_t count = std::min<std::size_t>(options.photonCount, 50000);
    PhotonTrial trial(
        makeDensitySurface(scene, several ? makeSurfaceRegions(scene, usualCreaseAngle) : wholeRegion(scene)),
        photonsOnScene(scene, count, random), device);
    const std::string name = fmt::format("table 8.2/{}", several ? "a map a region" : "one map");
    addBeside(name, "build", trial.buildSeconds(options.runs), several ? 0.08 : 0.56, results);
    const double lookups = trial.lookupSeconds(500, count, options.runs) * static_cast<double>(count);
    addBeside(name, "estimates at photons", lookups, several ? 5.88 : 13.80, results);
  }
}

/// Measures Table 14.1: maps of a few photons.
void measureSmallMaps(const Device& device, const IndirectOptions& options,
                      std::vector<BenchmarkResult>& results) {
  constexpr std::array<std::size_t, 4> counts = {300, 500, 1000, 2000};
  constexpr std::array<double, 4> lookups = {23e-6, 27e-6, 29e-6, 34e-6},
                                  builds = {0.10e-3, 0.18e-3, 0.39e-3, 0.84e-3};
  const CompiledScene scene = makeSquares(1);
  for (std::size_t row = 0; row < counts.size(); ++row) {
    std::mt19937 random(1);
    PhotonTrial trial(makeDensitySurface(scene, wholeRegion(scene)),
                      photonsOnSquare(counts[row], false, random), device);
    const std::string name = fmt::format("table 14.1/{} photons", counts[row]);
    addBeside(name, "build", trial.buildSeconds(20 * options.runs), builds[row], results);
    addBeside(name, "look-up of 100", trial.lookupSeconds(100, options.photonLookups, options.runs),
              lookups[row], results);
  }
}

/// Passes of photons of a point light above the square, whose irradiance is known.
class ErrorAgainstWork {
 public:
  ErrorAgainstWork(const Device& device, const IndirectOptions& options)
      : options_(options),
        scene_(makeSquares(1)),
        surface_(makeDensitySurface(scene_, wholeRegion(scene_))),
        estimator_(surface_, {}, device) {
    std::uniform_real_distribution<double> place(0.2, 0.8);
    for (int i = 0; i < 500; ++i) {
      const float x = static_cast<float>(place(random_)), z = static_cast<float>(place(random_));
      queries_.push_back({{x, 0.0f, z}, z > x ? 0u : 1u, {0, 1, 0}, 0.1f, PRELIGHT_WHOLE_REGION});
    }
  }

  void run(std::vector<BenchmarkResult>& results) {
    for (const double alpha : {1.0, 2.0 / 3.0}) {
      ProgressiveIrradiance progressive(queries_, alpha);
      for (int pass = 1; pass <= options_.photonPasses; ++pass) {
        progressive.addPass(makePhotonMaps(photonsOfLight(), surface_), estimator_);
        if ((pass & (pass - 1)) != 0) continue;
        const std::string name =
            fmt::format("{}/{} photons", alpha < 1.0 ? "shrinking radius" : "fixed radius",
                        pass * options_.photonsPerPass);
        results.push_back({name, "relative MSE", relativeError(progressive.irradiance()), "1", {}, {}});
      }
    }
  }

 private:
  static constexpr double height = 0.2;  // height of a light of 1 W above the middle, m

  static double truth(const float* at) {
    const double x = static_cast<double>(at[0]) - 0.5, z = static_cast<double>(at[2]) - 0.5;
    return height / (4.0 * pi * std::pow(x * x + z * z + height * height, 1.5));
  }

  std::vector<Photon> photonsOfLight() {
    std::uniform_real_distribution<double> unit;
    std::vector<Photon> photons;
    for (int i = 0; i < options_.photonsPerPass; ++i) {
      const double down = 2.0 * unit(random_) - 1.0, turn = 2.0 * pi * unit(random_);
      if (down <= 0.0) continue;
      const double reach = height * std::sqrt(1.0 - down * down) / down;
      const double x = 0.5 + reach * std::cos(turn), z = 0.5 + reach * std::sin(turn);
      if (x < 0.0 || x > 1.0 || z < 0.0 || z > 1.0) continue;
      photons.push_back(makePhoton({x, 0.0, z}, z > x ? 0 : 1, 1.0 / options_.photonsPerPass));
    }
    return photons;
  }

  double relativeError(const std::vector<glm::vec3>& found) const {
    double squares = 0.0, truths = 0.0;
    for (std::size_t i = 0; i < found.size(); ++i) {
      const double expected = truth(queries_[i].position);
      squares += std::pow(static_cast<double>(found[i].x) - expected, 2.0);
      truths += expected * expected;
    }
    return squares / truths;
  }

  const IndirectOptions& options_;
  CompiledScene scene_;
  DensitySurface surface_;
  DensityEstimator estimator_;
  std::mt19937 random_{1};
  std::vector<DensityQuery> queries_;
};

}  // namespace

void runPhotons(const Device& device, const IndirectOptions& options, SuiteRun& run) {
  std::vector<BenchmarkResult>& results = run.results();
  StepCounter steps(run, "bench photons", 4 * options.photonCounts.size() + 5);
  for (const std::uint64_t count : options.photonCounts)
    for (const bool spot : {false, true})
      for (const int nearest : {0, compared}) {
        TreesAgainstGrids(count, spot, nearest, device, options).run(run, results);
        steps.advance();
      }
  measureMaps(device, options, results);
  steps.advance();
  measurePhotons(device, options, results);
  steps.advance();
  measureSmallMaps(device, options, results);
  steps.advance();
  ErrorAgainstWork(device, options).run(results);
  steps.advance();
  measureCaustic(device, options, results);
  steps.advance();
}

}  // namespace prelight::benchmarks
