#include "benchmarks/detailed_scene.h"
#include "benchmarks/measure.h"
#include "benchmarks/ray_sets.h"
#include "benchmarks/suites.h"
#include "benchmarks/tree_counts.h"
#include "bvh/builder.h"
#include "bvh/bvh_report.h"

namespace prelight::benchmarks {

namespace {

constexpr std::uint64_t countedRays = 1u << 16;
constexpr std::uint32_t treesRaysPerReceiver = 64;

struct Quality {
  BuildQuality quality;
  const char* name;
};
constexpr Quality qualities[] = {
    {BuildQuality::Fast, "fast"}, {BuildQuality::Balanced, "balanced"}, {BuildQuality::High, "high"}};

void addTree(const std::string& name, const BvhReport& tree, const TreeCounts& steps,
             std::vector<BenchmarkResult>& results) {
  const auto add = [&](const char* metric, double value, const char* unit) {
    results.push_back({"trees", name, metric, value, unit, {}, {}});
  };
  add("build", tree.seconds, "s");
  add("nodes", steps.nodes, "a ray");
  add("blocks", steps.leaves, "a ray");
  add("expected cost", tree.sahCost, "a line");
  add("size", tree.bytesPerTriangle, "bytes/triangle");
  add("leaf fill", tree.meanLeafFill, "of 8");
  add("duplicates", tree.duplicates, "of triangles");
}

void measureTrees(const BenchmarkScene& scene, const Device& device, int runs,
                  std::vector<BenchmarkResult>& results) {
  const std::vector<device::Ray> rays =
      bakeRays(scene.compiled, device.context(), countedRays, treesRaysPerReceiver);
  for (const Quality& quality : qualities) {
    BinaryBvh tree;
    std::vector<double> seconds;
    for (int run = 0; run < runs; ++run) {
      tree = buildBvh(scene.compiled, {.quality = quality.quality});
      seconds.push_back(tree.buildSeconds);
    }
    tree.buildSeconds = median(seconds);
    addTree(scene.name + "/" + quality.name, reportOf(tree, scene.compiled.triangleCount()),
            countSteps(tree, scene.compiled, rays, false), results);
  }
}

}  // namespace

void runTreesSuite(const Device& device, const BenchmarkOptions& options, SuiteRun& run) {
  std::vector<BenchmarkScene> scenes = loadBuiltinScenes();
  for (const std::uint64_t triangles : options.rayTriangles) scenes.push_back(makeDetailedRooms(triangles));
  StepCounter steps(run, "bench trees", scenes.size());
  std::vector<BenchmarkResult>& results = run.results();
  for (const BenchmarkScene& scene : scenes) {
    measureTrees(scene, device, options.runs, results);
    steps.advance();
  }
}

}  // namespace prelight::benchmarks
