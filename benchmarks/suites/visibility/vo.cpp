#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <vector>

#include "benchmarks/run/measure.h"
#include "benchmarks/run/timing.h"
#include "benchmarks/scenes/detailed_scene.h"
#include "benchmarks/scenes/probe_lights.h"
#include "benchmarks/suites/visibility/direct_light.h"
#include "benchmarks/suites/visibility/visibility_suite.h"
#include "occluders/occluder_light.h"
#include "techniques/vector_occluders/occluder_relighter.h"

// [1] Sherif, "Vector occluders", 2013, Eq. 7.2.

namespace prelight::benchmarks {

namespace {

constexpr double trianglesOfVertex = 1.9;  // triangles per vertex of the detailed rooms
constexpr std::uint64_t shadingRays = 64;  // per vertex; the number of records matters here, not their noise

/// Shades every vertex with each number of lights, in turns.
class ShadingTurns {
 public:
  ShadingTurns(const BenchmarkScene& scene, const OccluderTransfer& transfer, const Device& device,
               const VisibilityOptions& options)
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
    results.push_back({place, "records per vertex", perVertex, "1", {}, {}});
    std::vector<Point> points;
    for (std::size_t i = 0; i < contenders.size(); ++i) {
      const double seconds = medianSeconds(contenders[i].cpuSeconds, 1);
      results.push_back({place + "/" + contenders[i].name, "processor time", seconds, "s", {}, {}});
      points.push_back({static_cast<double>(counts_[i] * transfer_.recordCount()), seconds});
    }
    const LineFit line = fitLine(points);
    results.push_back({place, "time of a record and light", std::max(line.slope, 0.0), "s", {}, {}});
    results.push_back({place, "R2 of a line", line.r2, "1", {}, {}});
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

/// Measures the processor time that vector occluders add to a bake of AO of `shapes`, in turns.
void measureOccluderBake(const Device& device, const VisibilityOptions& options, Progress& progress,
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
    results.push_back({name, "processor time", seconds, "s", {}, {}});
    if (&contender == &contenders[0]) continue;
    const double added = 1.0 / medianRatio(contender.cpuSeconds, contenders[0].cpuSeconds) - 1.0;
    results.push_back({name, "added processor time", std::max(added, 0.0), "of AO", {}, {}});
  }
}

/// Measures the processor time of shading many vertices by growing numbers of lights, and fits a line.
void measureOccluderShading(const Device& device, const VisibilityOptions& options, Progress& progress,
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

/// Seed of the points. The bake has seed 0, so that they are independent.
constexpr std::uint64_t pointSeed = 1;

struct NamedFormula {
  std::string name;
  OccluderShading shading;
};

/// Returns the formula of [1] with several strengths, and Prelight's.
std::vector<NamedFormula> formulas() {
  std::vector<NamedFormula> list;
  for (const double strength : {1.0, 2.0, 4.0}) {
    OccluderShading thesis;
    thesis.formula = OccluderFormula::Thesis;
    thesis.shadowStrength = strength;
    list.push_back({fmt::format("thesis, N = {:g}", strength), thesis});
  }
  list.push_back({"soft", {}});
  return list;
}

struct Grouping {
  const char* name;
  OccluderKind kind;
  double records;
};

constexpr std::array<Grouping, 2> groupings = {
    {{"node", OccluderKind::Node, 0.0}, {"auto:12", OccluderKind::Auto, 12.0}}};

Bake bakeOccluders(const BenchmarkScene& scene, const Grouping& grouping, std::uint64_t rays,
                   const Device& device, const Progress& progress) {
  BakeRequest request = aoRequest(rays, 0);
  request.occluders.wanted = true;
  request.occluders.kind = grouping.kind;
  if (grouping.kind == OccluderKind::Auto) request.occluders.records = grouping.records;
  return timedBake(scene, request, device, progress).bake;
}

prelight::IncidentLight towards(const glm::dvec3& light, const glm::dvec3& point) {
  const double distance = glm::distance(light, point);
  return {glm::dvec3(1.0), (light - point) / distance, distance};
}

/// Lights in one kind of place, and the truth with which shadows are compared.
class Trial {
 public:
  Trial(const BenchmarkScene& scene, std::string where, const DirectLight& direct,
        std::vector<BenchmarkResult>& results)
      : scene_(scene), metric_("error, lights " + where), direct_(direct), results_(results) {
    unshadowed_ = direct.error([](std::size_t, std::uint32_t) { return 1.0; });
    results.push_back({scene.name + "/no shadow", metric_, unshadowed_, "cosine", {}, {}});
    add("traced at vertices",
        [&](std::size_t light, std::uint32_t v) { return direct.tracedAtVertex(light, v); });
  }

  void ambientOcclusion(const std::vector<float>& ao) {
    add("AO", [&](std::size_t, std::uint32_t v) { return static_cast<double>(ao[v]); });
  }

  void occluders(const Grouping& grouping, const OccluderTransfer& transfer) {
    const glm::dvec3 origin = scene_.compiled.origin;
    for (const NamedFormula& formula : formulas())
      add(fmt::format("{}/{}", grouping.name, formula.name), [&](std::size_t light, std::uint32_t v) {
        const OccluderReceiver receiver{v, origin + glm::dvec3(scene_.compiled.positions[v]),
                                        glm::dvec3(scene_.compiled.normals[v])};
        return visibilityOf(transfer, receiver, towards(origin + direct_.lights()[light], receiver.position),
                            formula.shading);
      });
  }

 private:
  void add(const std::string& name, const DirectLight::Visibility& visibility) {
    const double error = direct_.error(visibility);
    const double relative = unshadowed_ > 0.0 ? error / unshadowed_ : 0.0;
    results_.push_back({scene_.name + "/" + name, metric_, relative, "of no shadow", {}, {}});
  }

  const BenchmarkScene& scene_;
  std::string metric_;
  const DirectLight& direct_;
  std::vector<BenchmarkResult>& results_;
  double unshadowed_ = 0.0;
};

void measureOccluders(const BenchmarkScene& scene, const Device& device, const VisibilityOptions& options,
                      const Progress& progress, std::vector<BenchmarkResult>& results) {
  Tracer tracer(scene.compiled, device);
  const std::array<std::vector<glm::dvec3>, 2> lights = {
      lightsAround(scene.compiled, options.voLights), lightsInside(scene.compiled, tracer, options.voLights)};
  std::array<Bake, groupings.size()> bakes;
  for (std::size_t g = 0; g < groupings.size(); ++g) {
    bakes[g] = bakeOccluders(scene, groupings[g], options.voRays, device, progress);
    const OccluderTransfer& transfer = *bakes[g].occluders;
    const auto vertices = static_cast<double>(scene.compiled.vertexCount());
    const std::string place = fmt::format("{}/{}", scene.name, groupings[g].name);
    const auto records = static_cast<double>(transfer.recordCount());
    results.push_back({place, "records per vertex", records / vertices, "1", {}, {}});
  }
  for (std::size_t kind = 0; kind < lights.size(); ++kind) {
    if (lights[kind].empty()) continue;
    const DirectLight direct(scene.compiled, tracer, lights[kind], options.voPoints, pointSeed);
    Trial trial(scene, kind == 0 ? "around" : "inside", direct, results);
    trial.ambientOcclusion(bakes[0].ao);
    for (std::size_t g = 0; g < groupings.size(); ++g) trial.occluders(groupings[g], *bakes[g].occluders);
  }
}

}  // namespace

void runVo(const Device& device, const VisibilityOptions& options, SuiteRun& run) {
  StepCounter steps(run, "bench vo", options.voScenes.size() + 2);
  std::vector<BenchmarkResult>& results = run.results();
  for (const std::string& name : options.voScenes) {
    measureOccluders(loadBuiltinScene(name), device, options, run, results);
    steps.advance();
  }
  measureOccluderBake(device, options, run, results);
  steps.advance();
  measureOccluderShading(device, options, run, results);
  steps.advance();
}

}  // namespace prelight::benchmarks
