#include <functional>

#include "benchmarks/run/measure.h"
#include "benchmarks/scenes/detailed_scene.h"
#include "benchmarks/suites/tracing/compare_rays.h"
#include "benchmarks/suites/tracing/tracing_suite.h"

namespace prelight::benchmarks {

namespace {

using device::Ray;

constexpr std::uint32_t raysRaysPerReceiver = 256;
constexpr float reach = 0.5f;  // metres, of rays of limited length

/// A kind of rays, made when its turn comes: all at once would not fit into small memories.
struct Recipe {
  const char* name;
  bool any;
  std::function<std::vector<Ray>()> make;
};

std::vector<Recipe> recipes(const BenchmarkScene& scene, Tracer& tracer, std::uint64_t count) {
  const auto bake = [&scene, &tracer, count] {
    return bakeLaunches(scene.compiled, tracer.context(), count, raysRaysPerReceiver);
  };
  return {{"bake-order", false, bake},
          {"random", false, [bake] { return shuffled(bake()); }},
          {"bake-order-any", true, bake},
          {"random-any", true, [bake] { return shuffled(bake()); }},
          {"bake-order-near", true, [bake] { return limited(bake(), reach); }},
          {"photon", false, [&scene, &tracer, count] { return photonRays(scene, tracer, count); }},
          {"camera", false, [&scene, count] { return cameraRays(scene, count); }}};
}

}  // namespace

void runRays(const Device& device, const TracingOptions& options, SuiteRun& run) {
  constexpr std::size_t cases = 7;
  StepCounter steps(run, "bench rays", options.rayTriangles.size() * (cases + 1));
  std::vector<BenchmarkResult>& results = run.results();
  for (const std::uint64_t triangles : options.rayTriangles) {
    const BenchmarkScene scene = makeDetailedRooms(triangles);
    Tracer tracer(scene.compiled, device);
    const std::vector<PeerTree> trees =
        makePeerTrees(scene.compiled, {PeerQuality::Medium, PeerQuality::High}, device.info());
    steps.advance();
    for (const Recipe& recipe : recipes(scene, tracer, options.rayCount)) {
      const RayCase rays{std::string(recipe.name) + " " + scene.name, recipe.make(), recipe.any};
      compareRays(rays, scene.compiled, tracer, trees, {options.rayRounds, true}, run, results);
      steps.advance();
    }
  }
}

}  // namespace prelight::benchmarks
