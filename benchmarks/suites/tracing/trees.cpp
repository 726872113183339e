#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "base/parallel.h"
#include "benchmarks/run/measure.h"
#include "benchmarks/scenes/detailed_scene.h"
#include "benchmarks/suites/tracing/ray_sets.h"
#include "benchmarks/suites/tracing/tracing_suite.h"
#include "bvh/binary_bvh.h"
#include "bvh/builder.h"
#include "bvh/bvh_report.h"
#include "prelight/compiled_scene.h"
#include "shared/ray_types.h"

namespace prelight::benchmarks {

namespace {

/// Nodes and leaves of a tree that a ray visits, mean over rays.
struct TreeCounts {
  double nodes = 0.0;   ///< wide nodes that are opened
  double leaves = 0.0;  ///< leaves (blocks of triangles) that are tested
  double hits = 0.0;    ///< rays that hit
};

struct Query {
  glm::vec3 origin, direction, inverse;
  float tMax;
  std::uint32_t source;
};

Query queryOf(const device::Ray& ray) {
  Query query{{ray.origin[0], ray.origin[1], ray.origin[2]},
              {ray.direction[0], ray.direction[1], ray.direction[2]},
              {},
              ray.tMax,
              ray.sourceTriangle};
  for (int axis = 0; axis < 3; ++axis) {
    const float d = query.direction[axis];
    query.inverse[axis] = 1.0f / (std::abs(d) > 1e-20f ? d : std::copysign(1e-20f, d));
  }
  return query;
}

std::optional<float> entry(const Box& box, const Query& query) {
  const glm::vec3 a = (box.lower - query.origin) * query.inverse,
                  b = (box.upper - query.origin) * query.inverse;
  const glm::vec3 near = glm::min(a, b), far = glm::max(a, b);
  const float first = std::max({near.x, near.y, near.z, 0.0f});
  const float last = std::min({far.x, far.y, far.z, query.tMax}) * 1.000001f;
  return first <= last ? std::optional(first) : std::nullopt;
}

std::optional<float> hitTriangle(const CompiledScene& scene, std::uint32_t triangle, const Query& query) {
  const glm::uvec3 t = scene.triangles[triangle];
  const glm::vec3 a = scene.positions[t.x], e1 = scene.positions[t.y] - a, e2 = scene.positions[t.z] - a;
  const glm::vec3 p = glm::cross(query.direction, e2);
  const float determinant = glm::dot(e1, p);
  if (determinant == 0.0f || triangle == query.source) return std::nullopt;
  const glm::vec3 s = query.origin - a, q = glm::cross(s, e1);
  const float u = glm::dot(s, p) / determinant, v = glm::dot(query.direction, q) / determinant;
  const float distance = glm::dot(e2, q) / determinant;
  if (u < 0.0f || v < 0.0f || u + v > 1.0f || distance < 0.0f || distance > query.tMax) return std::nullopt;
  return distance;
}

struct Waiting {
  float distance;
  std::uint32_t node;
};

class Walk {
 public:
  Walk(const BinaryBvh& bvh, const CompiledScene& scene, bool any) : bvh_(bvh), scene_(scene), any_(any) {}

  void trace(Query query) {
    bool hit = false;
    stack_ = {{0.0f, 0}};
    while (!stack_.empty()) {
      const Waiting next = stack_.back();
      stack_.pop_back();
      if (next.distance > query.tMax) continue;
      const BinaryBvh::Node& node = bvh_.nodes[next.node];
      if (node.count == 0) {
        open(node, query);
        continue;
      }
      ++leaves;
      for (std::uint32_t i = node.first; i < node.first + node.count; ++i)
        if (const auto t = hitTriangle(scene_, bvh_.triangleOrder[i], query)) {
          query.tMax = *t;
          hit = true;
        }
      if (hit && any_) break;
    }
    hits += hit;
  }

  std::uint64_t nodes = 0, leaves = 0, hits = 0;

 private:
  void open(const BinaryBvh::Node& node, const Query& query) {
    ++nodes;
    const std::size_t first = stack_.size();
    gather(node.left, query);
    gather(node.right, query);
    std::sort(stack_.begin() + static_cast<std::ptrdiff_t>(first), stack_.end(),
              [](const Waiting& a, const Waiting& b) { return a.distance > b.distance; });
  }

  void gather(std::uint32_t index, const Query& query) {
    const BinaryBvh::Node& node = bvh_.nodes[index];
    if (node.count == 0 && !node.wideRoot) {
      gather(node.left, query);
      gather(node.right, query);
    } else if (const auto distance = entry(node.bounds, query)) {
      stack_.push_back({*distance, index});
    }
  }

  const BinaryBvh& bvh_;
  const CompiledScene& scene_;
  bool any_;
  std::vector<Waiting> stack_;
};

/// Counts the steps of a traversal of the wide layout on the host, in order of distance. `any` stops at the
/// first hit. Counts depend only on the tree and the rays, so they compare trees without a clock.
TreeCounts countSteps(const BinaryBvh& bvh, const CompiledScene& scene, std::span<const device::Ray> rays,
                      bool any) {
  constexpr std::size_t grain = 4096;
  std::vector<Walk> walks((rays.size() + grain - 1) / grain, Walk(bvh, scene, any));
  parallelRanges(rays.size(), grain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) walks[begin / grain].trace(queryOf(rays[i]));
  });
  TreeCounts counts;
  for (const Walk& walk : walks) {
    counts.nodes += static_cast<double>(walk.nodes);
    counts.leaves += static_cast<double>(walk.leaves);
    counts.hits += static_cast<double>(walk.hits);
  }
  const double scale = 1.0 / static_cast<double>(std::max<std::size_t>(rays.size(), 1));
  return {counts.nodes * scale, counts.leaves * scale, counts.hits * scale};
}

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
    results.push_back({name, metric, value, unit, {}, {}});
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

void runTrees(const Device& device, const TracingOptions& options, SuiteRun& run) {
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
