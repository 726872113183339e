#include "benchmarks/suites/indirect/lightmaps.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "bake/make_plan.h"
#include "benchmarks/suites/indirect/indirect_suite.h"
#include "charts/light_map_charts.h"
#include "charts/light_map_lookup.h"
#include "charts/make_light_map_layout.h"
#include "charts/texel_sizes.h"
#include "charts/wall_search.h"
#include "receivers/sampling.h"
#include "techniques/light_map/light_map_sources.h"

namespace prelight::benchmarks {

namespace {

/// Sums over the points of a chart.
struct ChartSums {
  double weight = 0.0, light = 0.0, squares = 0.0;
};

void addPlaces(const BenchmarkScene& scene, const LightMapLayout& layout, double placesPerSquareMetre,
               SurfaceLight& light) {
  const CompiledScene& compiled = scene.compiled;
  for (std::uint32_t face = 0; face < layout.chartOf.size(); ++face) {
    if (layout.chartOf[face] == LightMapLayout::noChart) continue;
    const double area = 0.5 * glm::length(geometricNormal(compiled, face % compiled.triangleCount()));
    const auto count = static_cast<std::uint32_t>(std::ceil(area * placesPerSquareMetre));
    for (std::uint32_t i = 0; i < count; ++i) {
      const glm::dvec2 b = sampling::uniformTriangle(sampling::sobol(i, sampling::hashInteger(face + 17)));
      light.places.push_back({static_cast<std::uint32_t>(light.places.size()), face, static_cast<float>(b.x),
                              static_cast<float>(b.y)});
      light.weights.push_back(area / count);
    }
  }
}

}  // namespace

SurfaceLight lightOfSurface(const BenchmarkScene& scene, std::size_t places, BakeRequest request,
                            const Device& device, Progress& progress) {
  const Plan plan = makePlan(scene.scene, scene.compiled, request);
  const LightMapCharts charts = makeLightMapCharts(scene.scene, scene.compiled, LightMapLayoutRequest{});
  LightMapLayout layout = layOutLightMap(scene.compiled, charts);
  SurfaceLight light;
  addPlaces(scene, layout, static_cast<double>(places) / charts.area, light);
  Tracer tracer(scene.compiled, device);
  findWalls(scene.compiled, tracer, layout);
  std::vector<std::uint8_t> hidden(light.places.size(), 0);
  for (std::size_t i = 0; i < 2; ++i) {
    request.seed += 1000;
    LightMapSources sources(scene.scene, scene.compiled, layout, request, plan, 1, device, tracer, progress);
    light.light[i] = sources.irradiance(light.places, hidden, progress);
  }
  for (std::size_t i = 0; i < hidden.size(); ++i)
    if (hidden[i] != 0) light.weights[i] = 0.0;
  return light;
}

double errorOfLightMap(const LightMap& map, const LightMap& again, const SurfaceLight& light) {
  std::map<std::uint32_t, ChartSums> charts;
  ChartSums all;
  for (std::size_t i = 0; i < light.places.size(); ++i) {
    const LightMapTexel& place = light.places[i];
    const glm::dvec3 value = lightMapIrradiance(map, place.face, double(place.b1), double(place.b2));
    const glm::dvec3 other = lightMapIrradiance(again, place.face, double(place.b1), double(place.b2));
    double product = 0.0, sum = 0.0;
    for (int c = 0; c < 3; ++c) {
      const std::size_t at = 3 * i + static_cast<std::size_t>(c);
      const double one = light.light[0][at], two = light.light[1][at];
      product += (value[c] - one) * (other[c] - two) / 3.0;
      sum += (one + two) / 6.0;
    }
    for (ChartSums* sums : {&charts[map.layout.chartOf[place.face]], &all}) {
      sums->weight += light.weights[i];
      sums->light += light.weights[i] * sum;
      sums->squares += light.weights[i] * product;
    }
  }
  double squares = 0.0;
  for (const auto& [index, chart] : charts) {
    if (!(chart.weight > 0.0)) continue;
    const double mean =
        std::max(chart.light / chart.weight, TexelSizeRequest::darkestMean * all.light / all.weight);
    if (mean > 0.0) squares += chart.squares / (mean * mean);
  }
  return all.weight > 0.0 ? std::sqrt(std::max(0.0, squares / all.weight)) : 0.0;
}

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

  /// Measures a map with about `texels` texels of one size.
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
