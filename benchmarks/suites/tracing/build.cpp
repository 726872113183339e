#include "benchmarks/scenes/detailed_scene.h"
#include "benchmarks/suites/tracing/compare_builds.h"
#include "benchmarks/suites/tracing/tracing_suite.h"

namespace prelight::benchmarks {

void runBuild(const Device& device, const TracingOptions& options, SuiteRun& run) {
  StepCounter steps(run, "bench build", options.rayTriangles.size());
  std::vector<BenchmarkResult>& results = run.results();
  for (const std::uint64_t triangles : options.rayTriangles) {
    const BenchmarkScene scene = makeDetailedRooms(triangles);
    compareBuilds(scene.name, scene.compiled, device,
                  {PeerQuality::Low, PeerQuality::Medium, PeerQuality::High}, options.runs, run, results);
    steps.advance();
  }
}

}  // namespace prelight::benchmarks
