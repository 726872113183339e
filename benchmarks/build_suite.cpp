#include "benchmarks/compare_builds.h"
#include "benchmarks/detailed_scene.h"
#include "benchmarks/suites.h"

namespace prelight::benchmarks {

std::vector<BenchmarkResult> runBuildSuite(const Device& device, const BenchmarkOptions& options,
                                           Progress& progress) {
  StepCounter steps(progress, "bench build", options.rayTriangles.size());
  std::vector<BenchmarkResult> results;
  for (const std::uint64_t triangles : options.rayTriangles) {
    const BenchmarkScene scene = makeDetailedRooms(triangles);
    compareBuilds("build", scene.name, scene.compiled, device,
                  {PeerQuality::Low, PeerQuality::Medium, PeerQuality::High}, options.runs, progress,
                  results);
    steps.advance();
  }
  return results;
}

}  // namespace prelight::benchmarks
