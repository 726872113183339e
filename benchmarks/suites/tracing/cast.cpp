#include "benchmarks/run/measure.h"
#include "benchmarks/suites/tracing/ray_sets.h"
#include "benchmarks/suites/tracing/tracing_suite.h"
#include "gpu/tracer.h"

namespace prelight::benchmarks {

namespace {

constexpr std::uint32_t castRaysPerReceiver = 64;  // as in a bake of 1024 rays per vertex
std::string treeName(BvhLayout layout) { return layout == BvhLayout::Wide ? "wide tree" : "narrow tree"; }

BvhLayout otherLayout(BvhLayout layout) {
  return layout == BvhLayout::Wide ? BvhLayout::Narrow : BvhLayout::Wide;
}

/// The tree layout that the device uses and the other one, over the same scene.
struct Trees {
  Tracer chosen;
  Tracer other;

  Trees(const CompiledScene& scene, const Device& device)
      : chosen(scene, device), other(scene, device, otherLayout(chosen.layout())) {}
};

/// One order of rays with one kind of query, and seconds per run of both trees.
struct CastCase {
  std::string name;
  RayBlocks* rays;
  bool any;
  std::vector<double> chosen = {};
  std::vector<double> other = {};

  void run(Trees& trees) {
    chosen.push_back(secondsThrough(trees.chosen));
    other.push_back(secondsThrough(trees.other));
  }

  BenchmarkResult result(const Trees& trees) const {
    return {name,
            "throughput",
            static_cast<double>(rays->rayCount()) / median(chosen),
            "rays/s",
            treeName(trees.other.layout()),
            median(other) / median(chosen)};
  }

 private:
  double secondsThrough(Tracer& tracer) const {
    return secondsOf([&] { rays->trace(tracer, any, 0, rays->launchCount()); });
  }
};

/// Measures trees and cases in turns, run by run, so that disturbances affect all of them.
void measureCast(const BenchmarkScene& scene, const Device& device, const TracingOptions& options,
                 StepCounter& steps, std::vector<BenchmarkResult>& results) {
  Trees trees(scene.compiled, device);
  const std::vector<device::Ray> rays =
      bakeRays(scene.compiled, device.context(), options.castRays, castRaysPerReceiver);
  RayBlocks inBakeOrder(device.context(), rays);
  RayBlocks inRandomOrder(device.context(), shuffled(rays));
  const std::vector<CastCase> cases = {{scene.name + "/bake order/closest hit", &inBakeOrder, false},
                                       {scene.name + "/bake order/any hit", &inBakeOrder, true},
                                       {scene.name + "/random order/closest hit", &inRandomOrder, false},
                                       {scene.name + "/random order/any hit", &inRandomOrder, true}};
  for (CastCase warmUp : cases) warmUp.run(trees);
  steps.advance();
  std::vector<CastCase> measured = cases;
  for (int run = 0; run < options.runs; ++run) {
    for (CastCase& one : measured) one.run(trees);
    steps.advance();
  }
  for (const CastCase& one : measured) results.push_back(one.result(trees));
}

}  // namespace

void runCast(const Device& device, const TracingOptions& options, SuiteRun& run) {
  const std::vector<BenchmarkScene> scenes = loadBuiltinScenes();
  StepCounter steps(run, "bench cast", scenes.size() * static_cast<std::size_t>(options.runs + 1));
  std::vector<BenchmarkResult>& results = run.results();
  for (const BenchmarkScene& scene : scenes) measureCast(scene, device, options, steps, results);
}

}  // namespace prelight::benchmarks
