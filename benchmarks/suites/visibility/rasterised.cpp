#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "basis/sh_evaluate.h"
#include "benchmarks/run/measure.h"
#include "benchmarks/run/timing.h"
#include "benchmarks/suites/visibility/visibility_suite.h"
#include "gpu/tracer.h"
#include "receivers/sampling.h"
#include "receivers/surface_sampler.h"
#include "viewer/gl/egl_context.h"
#include "viewer/hemisphere/hemisphere_raster.h"

namespace prelight::benchmarks {

namespace {

using Gathered = viewer::HemisphereGather;
using viewer::HemisphereMap;
using viewer::HemisphereReceiver;

constexpr float third = 1.0f / 3.0f;
constexpr std::size_t raysAtOnce = std::size_t(1) << 20;

/// Points on a scene's surface, and the radiance of its vertices.
struct RasterisedScene {
  BenchmarkScene scene;
  std::vector<HemisphereReceiver> receivers;
  std::vector<std::uint32_t> triangles;  ///< [receiver] its triangle
  std::vector<glm::vec3> radiance;       ///< [vertex] radiance of a pattern
};

/// Returns a scene whose receivers are the middles of every n-th triangle.
RasterisedScene makeScene(const std::string& name, std::size_t most) {
  RasterisedScene made{loadNamedScene(name), {}, {}, {}};
  const CompiledScene& scene = made.scene.compiled;
  const std::size_t step = std::max<std::size_t>(1, scene.triangleCount() / most);
  for (std::size_t t = 0; t < scene.triangleCount() && made.receivers.size() < most; t += step) {
    if (glm::length(geometricNormal(scene, static_cast<std::uint32_t>(t))) <= 0.0) continue;
    // Lifted off its triangle as in a bake: what coincides with the triangle does not hide it.
    const device::Receiver placed =
        receiverAt(scene, {static_cast<std::uint32_t>(t), third, third}, Side::Front);
    const glm::dvec3 up(placed.geometricNormal[0], placed.geometricNormal[1], placed.geometricNormal[2]);
    made.receivers.push_back({{placed.position[0], placed.position[1], placed.position[2]},
                              up,
                              0.0,
                              static_cast<std::uint32_t>(t),
                              glm::vec3(up)});
    made.triangles.push_back(static_cast<std::uint32_t>(t));
  }
  for (const glm::vec3& p : scene.positions)
    made.radiance.push_back(0.5f + 0.4f * glm::sin(3.0f * glm::vec3(p.x, p.y, p.z)));
  return made;
}

glm::vec3 radianceAt(const RasterisedScene& scene, const device::Hit& hit) {
  const glm::uvec3& v = scene.scene.compiled.triangles[hit.triangle];
  return (1.0f - hit.u - hit.v) * scene.radiance[v.x] + hit.u * scene.radiance[v.y] +
         hit.v * scene.radiance[v.z];
}

/// Returns cosine-distributed rays of receivers from `first` on, [receiver][ray].
std::vector<device::Ray> raysOf(const RasterisedScene& scene, std::size_t first, std::size_t receivers,
                                std::uint32_t rays, std::uint32_t seed) {
  std::vector<device::Ray> cast;
  cast.reserve(receivers * rays);
  for (std::size_t i = first; i < first + receivers; ++i) {
    const glm::vec3 p(scene.receivers[i].position);
    const std::uint32_t scramble = sampling::hashInteger(seed + static_cast<std::uint32_t>(i));
    for (std::uint32_t r = 0; r < rays; ++r) {
      const glm::vec3 d = sampling::cosineHemisphere(sampling::sobol(r, scramble), scene.receivers[i].normal);
      cast.push_back({{p.x, p.y, p.z}, scene.triangles[i], {d.x, d.y, d.z}, 1e30f});
    }
  }
  return cast;
}

/// Adds the results of the rays of one receiver.
void addReceiver(const RasterisedScene& scene, std::span<const device::Ray> cast,
                 std::span<const device::Hit> hits, int order, Gathered& found) {
  const auto rays = static_cast<double>(cast.size());
  std::vector<double> values(static_cast<std::size_t>(sh::coefficientCount(order)));
  std::vector<double> transfer(values.size(), 0.0);
  glm::dvec3 sum(0.0);
  for (std::size_t r = 0; r < cast.size(); ++r) {
    if (hits[r].triangle != PRELIGHT_NO_TRIANGLE) {
      sum += glm::dvec3(radianceAt(scene, hits[r]));
      continue;
    }
    const auto& d = cast[r].direction;
    sh::evaluate(glm::normalize(glm::dvec3(d[0], d[1], d[2])), order, values);
    for (std::size_t c = 0; c < values.size(); ++c) transfer[c] += values[c] / rays;
  }
  found.transfer.insert(found.transfer.end(), transfer.begin(), transfer.end());
  found.irradiance.emplace_back(std::numbers::pi * sum / rays);
}

Gathered byRays(const RasterisedScene& scene, Tracer& tracer, std::uint32_t rays, int order,
                std::uint32_t seed) {
  const std::size_t most = std::max<std::size_t>(1, raysAtOnce / rays);
  Gathered found;
  for (std::size_t first = 0; first < scene.receivers.size(); first += most) {
    const std::size_t some = std::min(most, scene.receivers.size() - first);
    const std::vector<device::Ray> cast = raysOf(scene, first, some, rays, seed);
    const std::vector<device::Hit> hits = tracer.traceClosest(cast);
    for (std::size_t i = 0; i < some; ++i)
      addReceiver(scene, std::span(cast).subspan(i * rays, rays), std::span(hits).subspan(i * rays, rays),
                  order, found);
  }
  return found;
}

/// Returns the RMS difference divided by the RMS of the truth.
double errorOf(std::span<const double> values, std::span<const double> truth) {
  double difference = 0.0, size = 0.0;
  for (std::size_t i = 0; i < truth.size(); ++i) {
    difference += (values[i] - truth[i]) * (values[i] - truth[i]);
    size += truth[i] * truth[i];
  }
  return std::sqrt(difference / size);
}

std::vector<double> numbersOf(const std::vector<glm::vec3>& colors) {
  std::vector<double> numbers;
  for (const glm::vec3& c : colors) numbers.insert(numbers.end(), {c.x, c.y, c.z});
  return numbers;
}

/// Computes both in one way, and adds errors and processor time per receiver.
void measure(const std::string& name, const std::function<Gathered()>& find, std::size_t receivers,
             const Gathered& truth, std::vector<BenchmarkResult>& results) {
  const double before = processorSeconds();
  const Gathered found = find();
  const double seconds = processorSeconds() - before;
  const auto add = [&](const char* metric, double value, const char* unit) {
    results.push_back({name, metric, value, unit, {}, {}});
  };
  if (!truth.transfer.empty()) add("error of transfer", errorOf(found.transfer, truth.transfer), "of it");
  add("error of irradiance", errorOf(numbersOf(found.irradiance), numbersOf(truth.irradiance)), "of it");
  add("processor time", 1e6 * seconds / double(receivers), "us a receiver");
}

/// Returns the hemi-planes that are measured besides the default.
const std::vector<std::pair<std::string, viewer::HemiPlane>>& otherPlanes() {
  using viewer::LostLight;
  static const std::vector<std::pair<std::string, viewer::HemiPlane>> planes = [] {
    std::vector<std::pair<std::string, viewer::HemiPlane>> all;
    for (const double halfWidth : {2.25, 4.0, 8.0})
      for (const LostLight lost : {LostLight::Dark, LostLight::Mean, LostLight::Rim}) {
        const viewer::HemiPlane plane{halfWidth, lost}, usual;
        if (halfWidth == usual.halfWidth && lost == usual.lost) continue;
        all.emplace_back(
            fmt::format(" {}, {}", halfWidth, viewer::lostLightNames[static_cast<std::size_t>(lost)]), plane);
      }
    return all;
  }();
  return planes;
}

void measureScene(const std::string& sceneOrFile, const Device& device, const VisibilityOptions& options,
                  std::vector<BenchmarkResult>& results) {
  const RasterisedScene scene = makeScene(sceneOrFile, options.rasterisedReceivers);
  const std::string& name = scene.scene.name;
  const int order = options.rasterisedOrder;
  Tracer tracer(scene.scene.compiled, device);
  Gathered truth = byRays(scene, tracer, options.rasterisedTruthRays, order, 1);
  double size = 0.0;
  for (const double value : truth.transfer) size += value * value;
  if (size <= 0.0) truth.transfer.clear();  // no sky is visible in closed rooms
  for (const int side : options.rasterisedSides) {
    const auto texels = static_cast<std::uint32_t>(side * side);
    measure(
        fmt::format("{}/rays/{}", name, texels), [&] { return byRays(scene, tracer, texels, order, 77); },
        scene.receivers.size(), truth, results);
    const auto draw = [&](HemisphereMap map, const std::string& how, viewer::HemisphereSums by,
                          const viewer::HemiPlane& plane = {},
                          viewer::DiscEdges edges = viewer::DiscEdges::Exact) {
      viewer::HemisphereRaster raster(scene.scene.compiled, map, side, by, plane, edges);
      measure(
          fmt::format("{}/{}{}/{}x{}", name, viewer::hemisphereMapNames[static_cast<std::size_t>(map)], how,
                      side, side),
          [&] { return raster.gather(scene.receivers, order, scene.radiance); }, scene.receivers.size(),
          truth, results);
    };
    for (std::size_t m = 0; m < viewer::hemisphereMapNames.size(); ++m)
      draw(static_cast<HemisphereMap>(m), "", viewer::HemisphereSums::MipLevels);
    draw(HemisphereMap::Stereographic, " in four passes", viewer::HemisphereSums::FourPasses);
    for (const HemisphereMap map : {HemisphereMap::Stereographic, HemisphereMap::Orthographic})
      for (const viewer::DiscEdges edges : {viewer::DiscEdges::Pieces, viewer::DiscEdges::Projected})
        draw(map, fmt::format(", {} edges", viewer::discEdgeNames[static_cast<std::size_t>(edges)]),
             viewer::HemisphereSums::MipLevels, {}, edges);
    for (const auto& [how, plane] : otherPlanes())
      draw(HemisphereMap::HemiPlane, how, viewer::HemisphereSums::MipLevels, plane);
  }
}

}  // namespace

void runRasterised(const Device& device, const VisibilityOptions& options, SuiteRun& run) {
  std::vector<BenchmarkResult>& results = run.results();
  const viewer::gl::EglContext context;
  StepCounter steps(run, "bench rasterised", options.rasterisedScenes.size());
  for (const std::string& name : options.rasterisedScenes) {
    measureScene(name, device, options, results);
    steps.advance();
  }
}

}  // namespace prelight::benchmarks
