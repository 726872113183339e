#include "benchmarks/compare_builds.h"
#include "benchmarks/detailed_scene.h"
#include "benchmarks/suites.h"

namespace prelight::benchmarks {

void runBuildSuite(const Device& device, const BenchmarkOptions& options, SuiteRun& run) {
  StepCounter steps(run, "bench build", options.rayTriangles.size());
  std::vector<BenchmarkResult>& results = run.results();
  for (const std::uint64_t triangles : options.rayTriangles) {
    const BenchmarkScene scene = makeDetailedRooms(triangles);
    compareBuilds("build", scene.name, scene.compiled, device,
                  {PeerQuality::Low, PeerQuality::Medium, PeerQuality::High}, options.runs, run, results);
    steps.advance();
  }
}

}  // namespace prelight::benchmarks
