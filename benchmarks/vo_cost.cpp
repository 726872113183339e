#include "benchmarks/vo_cost.h"

#include <fmt/format.h>

#include <algorithm>

#include "benchmarks/detailed_scene.h"
#include "benchmarks/line_fit.h"
#include "benchmarks/measure.h"
#include "benchmarks/probe_lights.h"
#include "benchmarks/take_turns.h"
#include "relight/occluder_relighter.h"

namespace prelight::benchmarks {

namespace {

constexpr double trianglesOfVertex = 1.9;  // of the detailed rooms
constexpr std::uint64_t shadingRays = 64;  // a vertex: what records there are matters here, not their noise

/// Shades every vertex by each number of lights, in turns.
class ShadingTurns {
 public:
  ShadingTurns(const BenchmarkScene& scene, const OccluderTransfer& transfer, const Device& device,
               const BenchmarkOptions& options)
      : scene_(scene.compiled),
        transfer_(transfer),
        context_(device.context()),
        counts_(options.voLightCounts),
        relighter_(context_, transfer, {scene_.positions, scene_.normals, scene_.origin}),
        lit_(context_, scene_.vertexCount()) {
    const std::size_t most = *std::max_element(counts_.begin(), counts_.end());
    for (const glm::dvec3& place : lightsAround(scene_, most))
      lights_.push_back(occluderPointLight(place, glm::dvec3(1.0), 0.0));
  }

  void run(int rounds, const Progress& progress, std::vector<BenchmarkResult>& results) {
    std::vector<Contender> contenders;
    for (const std::size_t count : counts_)
      contenders.push_back({fmt::format("{} lights", count), [this, count](std::size_t) { shade(count); }});
    takeTurns(contenders, 1, rounds, progress);
    const std::string place = fmt::format("shading/{} vertices", scene_.vertexCount());
    const double perVertex = static_cast<double>(transfer_.recordCount()) / scene_.vertexCount();
    results.push_back({"vo", place, "records a vertex", perVertex, "1", {}, {}});
    std::vector<Point> points;
    for (std::size_t i = 0; i < contenders.size(); ++i) {
      const double seconds = medianSeconds(contenders[i].cpuSeconds, 1);
      results.push_back({"vo", place + "/" + contenders[i].name, "processor time", seconds, "s", {}, {}});
      points.push_back({static_cast<double>(counts_[i] * transfer_.recordCount()), seconds});
    }
    const LineFit line = fitLine(points);
    results.push_back({"vo", place, "time of a record and light", std::max(line.slope, 0.0), "s", {}, {}});
    results.push_back({"vo", place, "R2 of a line", line.r2, "1", {}, {}});
  }

 private:
  void shade(std::size_t count) {
    relighter_.relight(std::span(lights_.data(), count), {}, {}, lit_);
    context_.finish();
  }

  const CompiledScene& scene_;
  const OccluderTransfer& transfer_;
  DeviceContext& context_;
  std::vector<std::size_t> counts_;
  std::vector<device::OccluderLight> lights_;
  OccluderRelighter relighter_;
  Buffer<device::LitVertex> lit_;
};

}  // namespace

void measureOccluderBake(const Device& device, const BenchmarkOptions& options, Progress& progress,
                         std::vector<BenchmarkResult>& results) {
  const BenchmarkScene scene = loadBuiltinScene("shapes");
  const BakeRequest plain = aoRequest(options.voCostRays, 0);
  BakeRequest byNode = plain;
  byNode.occluders.wanted = true;
  BakeRequest byPart = byNode;
  byPart.occluders.kind = OccluderKind::Auto;
  byPart.occluders.records = 12.0;
  const auto bakes = [&](const BakeRequest& request) {
    return [&, request](std::size_t) { timedBake(scene, request, device, progress); };
  };
  std::vector<Contender> contenders = {
      {"AO", bakes(plain)}, {"AO and VO/node", bakes(byNode)}, {"AO and VO/auto:12", bakes(byPart)}};
  takeTurns(contenders, 1, options.voCostRounds, progress);
  const std::string place = fmt::format("bake/shapes, {} rays", options.voCostRays);
  for (const Contender& contender : contenders) {
    const std::string name = place + "/" + contender.name;
    const double seconds = medianSeconds(contender.cpuSeconds, 1);
    results.push_back({"vo", name, "processor time", seconds, "s", {}, {}});
    if (&contender == &contenders[0]) continue;
    const double added = 1.0 / medianRatio(contender.cpuSeconds, contenders[0].cpuSeconds) - 1.0;
    results.push_back({"vo", name, "added processor time", std::max(added, 0.0), "of AO", {}, {}});
  }
}

void measureOccluderShading(const Device& device, const BenchmarkOptions& options, Progress& progress,
                            std::vector<BenchmarkResult>& results) {
  const auto triangles =
      static_cast<std::uint64_t>(trianglesOfVertex * static_cast<double>(options.voShadingVertices));
  const BenchmarkScene scene = makeDetailedRooms(std::max<std::uint64_t>(triangles, 1000));
  BakeRequest request;
  request.occluders.wanted = true;
  request.effort.rays = shadingRays;
  const Bake bake = timedBake(scene, request, device, progress).bake;
  ShadingTurns(scene, *bake.occluders, device, options).run(options.voShadingRounds, progress, results);
}

}  // namespace prelight::benchmarks
