#include <fmt/format.h>

#include "benchmarks/suites/indirect/indirect_suite.h"
#include "benchmarks/suites/indirect/light_map_error.h"
#include "charts/light_map_charts.h"

namespace prelight::benchmarks {

namespace {

class LightMapTrial {
 public:
  LightMapTrial(const BenchmarkScene& scene, const IndirectOptions& options, const Device& device,
                Progress& progress)
      : scene_(scene),
        options_(options),
        device_(device),
        progress_(progress),
        truth_(lightOfSurface(scene, options.lightMapPlaces, requestOf(options.lightMapTruthRays), device,
                              progress)) {}

  /// All texels of one size, such that there are about so many.
  void measureSize(std::uint32_t texels, std::vector<BenchmarkResult>& results) {
    LightMapLayoutRequest shape;
    shape.texels = texels;
    BakeRequest request = requestOf(options_.lightMapRays);
    request.lightMap.texelSize = makeLightMapCharts(scene_.scene, scene_.compiled, shape).texelSize;
    measure(request, fmt::format("{}/one size/{}", scene_.name, texels), results);
  }

  void measureError(double error, std::vector<BenchmarkResult>& results) {
    BakeRequest request = requestOf(options_.lightMapRays);
    request.lightMap.error = error;
    measure(request, fmt::format("{}/by error/{:g}", scene_.name, error), results);
  }

 private:
  BakeRequest requestOf(std::uint64_t rays) const {
    BakeRequest request;
    request.lightMap.wanted = true;
    request.effort.rays = rays;
    request.lightMap.photons = options_.lightMapPhotons;
    return request;
  }

  void measure(const BakeRequest& request, const std::string& name, std::vector<BenchmarkResult>& results) {
    const TimedBake run = timedBake(scene_, request, device_, progress_);
    const LightMap& map = *run.bake.lightMap;
    const auto add = [&](const char* metric, double value, const char* unit) {
      results.push_back({name, metric, value, unit, {}, {}});
    };
    add("texels", static_cast<double>(map.layout.texels.size()), "");
    add("bytes", static_cast<double>(map.values.size() * sizeof(float)), "B");
    add("bake", run.seconds(), "s");
    add("rays", static_cast<double>(run.report.rays), "");
    BakeRequest other = request;
    other.seed += 1;
    const TimedBake again = timedBake(scene_, other, device_, progress_);
    add("error", errorOfLightMap(map, map, truth_), "of the mean");
    add("error without noise", errorOfLightMap(map, *again.bake.lightMap, truth_), "of the mean");
    if (!run.report.lightMap->sizes) return;
    add("expected error", run.report.lightMap->sizes->error, "of the mean");
    add("limited charts", run.report.lightMap->sizes->limited, "");
  }

  const BenchmarkScene& scene_;
  const IndirectOptions& options_;
  const Device& device_;
  Progress& progress_;
  SurfaceLight truth_;
};

}  // namespace

void runLightMaps(const Device& device, const IndirectOptions& options, SuiteRun& run) {
  std::vector<BenchmarkResult>& results = run.results();
  StopOnly quiet(run);
  StepCounter steps(
      run, "bench lightmaps",
      options.lightMapScenes.size() * (options.lightMapTexels.size() + options.lightMapErrors.size()));
  for (const std::string& name : options.lightMapScenes) {
    const BenchmarkScene scene = loadBuiltinScene(name);
    LightMapTrial trial(scene, options, device, quiet);
    for (const std::uint32_t texels : options.lightMapTexels) {
      trial.measureSize(texels, results);
      steps.advance();
    }
    for (const double error : options.lightMapErrors) {
      trial.measureError(error, results);
      steps.advance();
    }
  }
}

}  // namespace prelight::benchmarks
