#include "benchmarks/suites/indirect/light_map_error.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "bake/make_plan.h"
#include "charts/light_map_lookup.h"
#include "charts/make_light_map_layout.h"
#include "charts/texel_sizes.h"
#include "charts/wall_search.h"
#include "techniques/light_map/light_map_sources.h"
#include "receivers/sampling.h"

namespace prelight::benchmarks {

namespace {

/// Sums over a chart's places.
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

}  // namespace prelight::benchmarks
