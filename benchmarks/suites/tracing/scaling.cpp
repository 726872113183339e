#include <sys/resource.h>

#include "benchmarks/scenes/detailed_scene.h"
#include "benchmarks/suites/tracing/compare_builds.h"
#include "benchmarks/suites/tracing/compare_rays.h"
#include "benchmarks/suites/tracing/tracing_suite.h"

namespace prelight::benchmarks {

namespace {

constexpr std::uint32_t scalingRaysPerReceiver = 256;
constexpr std::uint64_t largeScene = 2000000;  // from here on a tree is built once: it takes seconds

/// Most memory that this process has held so far, bytes.
double peakMemory() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return 1024.0 * static_cast<double>(usage.ru_maxrss);
}

}  // namespace

void runScaling(const Device& device, const TracingOptions& options, SuiteRun& run) {
  constexpr std::size_t stepsPerScene = 3;
  StepCounter steps(run, "bench scaling", options.scalingTriangles.size() * stepsPerScene);
  std::vector<BenchmarkResult>& results = run.results();
  for (const std::uint64_t triangles : options.scalingTriangles) {
    const BenchmarkScene scene = makeDetailedRooms(triangles);
    const std::vector<PeerQuality> quality = {PeerQuality::Medium};
    compareBuilds(scene.name, scene.compiled, device, {PeerQuality::Medium, PeerQuality::High},
                  triangles < largeScene ? options.runs : 1, run, results);
    steps.advance();
    Tracer tracer(scene.compiled, device);
    const std::vector<PeerTree> trees = makePeerTrees(scene.compiled, quality, device.info());
    const RayComparison how{.rounds = options.rayRounds, .packets = false};
    RayCase rays{"bake-order " + scene.name,
                 bakeLaunches(scene.compiled, device.context(), options.rayCount, scalingRaysPerReceiver),
                 false};
    compareRays(rays, scene.compiled, tracer, trees, how, run, results);
    steps.advance();
    rays = {"random " + scene.name, shuffled(std::move(rays.rays)), false};
    compareRays(rays, scene.compiled, tracer, trees, how, run, results);
    results.push_back({scene.name, "peak memory", peakMemory(), "bytes", {}, {}});
    steps.advance();
  }
}

}  // namespace prelight::benchmarks
