#include <fmt/format.h>

#include <array>

#include "benchmarks/direct_light.h"
#include "benchmarks/measure.h"
#include "benchmarks/probe_lights.h"
#include "benchmarks/suites.h"
#include "benchmarks/vo_cost.h"
#include "occluders/occluder_light.h"

// [1] Sherif, "Vector occluders", 2013, Eq. 7.2.

namespace prelight::benchmarks {

namespace {

/// The bake has seed 0: its directions are none of the points'.
constexpr std::uint64_t pointSeed = 1;

struct NamedFormula {
  std::string name;
  OccluderShading shading;
};

/// The formula of [1] by its strength, and Prelight's.
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

IncidentLight towards(const glm::dvec3& light, const glm::dvec3& point) {
  const double distance = glm::distance(light, point);
  return {glm::dvec3(1.0), (light - point) / distance, distance};
}

/// Lights in one kind of place and what shadows of theirs are compared with.
class Trial {
 public:
  Trial(const BenchmarkScene& scene, std::string where, const DirectLight& direct,
        std::vector<BenchmarkResult>& results)
      : scene_(scene), metric_("error, lights " + where), direct_(direct), results_(results) {
    unshadowed_ = direct.error([](std::size_t, std::uint32_t) { return 1.0; });
    results.push_back({"vo", scene.name + "/no shadow", metric_, unshadowed_, "cosine", {}, {}});
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
    results_.push_back({"vo", scene_.name + "/" + name, metric_, relative, "of no shadow", {}, {}});
  }

  const BenchmarkScene& scene_;
  std::string metric_;
  const DirectLight& direct_;
  std::vector<BenchmarkResult>& results_;
  double unshadowed_ = 0.0;
};

void measureOccluders(const BenchmarkScene& scene, const Device& device, const BenchmarkOptions& options,
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
    results.push_back({"vo", place, "records a vertex", records / vertices, "1", {}, {}});
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

void runVoSuite(const Device& device, const BenchmarkOptions& options, SuiteRun& run) {
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
