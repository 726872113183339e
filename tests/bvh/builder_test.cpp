#include "bvh/builder.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <functional>
#include <random>

#include "bvh/bvh_report.h"
#include "bvh/morton_tree.h"
#include "bvh/parallel_partition.h"
#include "bvh/top_down.h"
#include "support/scenes.h"

namespace prelight {
namespace {

constexpr BuildQuality qualities[] = {BuildQuality::Fast, BuildQuality::Balanced, BuildQuality::High};
constexpr BvhTarget targets[] = {BvhTarget::Wide, BvhTarget::Narrow};

/// Needles in all directions, whose boxes overlap wherever they are split.
CompiledScene needles(std::size_t count, std::uint32_t seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<float> unit(-1.0f, 1.0f);
  std::vector<glm::vec3> positions;
  std::vector<glm::uvec3> triangles;
  for (std::size_t i = 0; i < count; ++i) {
    const glm::vec3 centre(unit(random), unit(random), unit(random)), along = test::randomDirection(random);
    const auto first = static_cast<std::uint32_t>(positions.size());
    positions.insert(positions.end(), {centre - 0.1f * along, centre + 0.1f * along,
                                       centre + 0.01f * test::randomDirection(random)});
    triangles.push_back({first, first + 1, first + 2});
  }
  return test::sceneOf(std::move(positions), std::move(triangles));
}

bool holds(const Box& box, const glm::dvec3& p, double slack) {
  return glm::all(glm::lessThanEqual(glm::dvec3(box.lower) - slack, p)) &&
         glm::all(glm::lessThanEqual(p, glm::dvec3(box.upper) + slack));
}

bool holds(const Box& outer, const Box& inner) {
  return glm::all(glm::lessThanEqual(outer.lower, inner.lower)) &&
         glm::all(glm::lessThanEqual(inner.upper, outer.upper));
}

/// Checks what holds for every tree: parents contain their children, leaves hold 1 to 8 triangles, the depth
/// is as stated, and wide nodes have at most eight children.
void expectSound(const BinaryBvh& bvh, BvhTarget target) {
  struct Visit {
    std::uint32_t node, level;
  };
  std::vector<Visit> open{{0, 1}};
  std::size_t named = 0, visited = 0;
  std::uint32_t depth = 0;
  while (!open.empty()) {
    const Visit visit = open.back();
    open.pop_back();
    ++visited;
    const BinaryBvh::Node& node = bvh.nodes[visit.node];
    depth = std::max(depth, visit.level);
    if (node.count > 0) {
      ASSERT_LE(node.count, BinaryBvh::maxLeafSize);
      ASSERT_LE(node.first + node.count, bvh.triangleOrder.size());
      named += node.count;
      continue;
    }
    for (const std::uint32_t child : {node.left, node.right}) {
      ASSERT_GT(child, visit.node);
      ASSERT_LT(child, bvh.nodes.size());
      EXPECT_TRUE(holds(node.bounds, bvh.nodes[child].bounds));
      open.push_back({child, visit.level + 1});
    }
    if (target != BvhTarget::Wide || !node.wideRoot) continue;
    std::size_t children = 0;
    const std::function<void(std::uint32_t)> countChildren = [&](std::uint32_t i) {
      const BinaryBvh::Node& n = bvh.nodes[i];
      if (n.count > 0 || n.wideRoot) {
        ++children;
        return;
      }
      countChildren(n.left);
      countChildren(n.right);
    };
    countChildren(node.left);
    countChildren(node.right);
    EXPECT_LE(children, 8u);
  }
  EXPECT_EQ(visited, bvh.nodes.size());
  EXPECT_EQ(named, bvh.triangleOrder.size());
  EXPECT_EQ(depth, bvh.depth);
  EXPECT_LE(depth, BinaryBvh::maxDepth);
}

/// Boxes of all leaves that hold a triangle, [triangle].
std::vector<std::vector<Box>> boxesByTriangle(const BinaryBvh& bvh, std::size_t triangles) {
  std::vector<std::vector<Box>> boxes(triangles);
  for (const BinaryBvh::Node& node : bvh.nodes)
    for (std::uint32_t i = node.first; i < node.first + node.count; ++i)
      boxes[bvh.triangleOrder[i]].push_back(node.bounds);
  return boxes;
}

/// Every point of every triangle is in a leaf that holds the triangle.
void expectCovered(const BinaryBvh& bvh, const CompiledScene& scene, double slack) {
  const auto boxes = boxesByTriangle(bvh, scene.triangleCount());
  std::size_t missed = 0;
  for (std::uint32_t t = 0; t < scene.triangleCount(); ++t) {
    ASSERT_FALSE(boxes[t].empty()) << "triangle " << t << " is in no leaf";
    const glm::uvec3 corners = scene.triangles[t];
    const glm::dvec3 a(scene.positions[corners.x]), b(scene.positions[corners.y]),
        c(scene.positions[corners.z]);
    constexpr int steps = 12;
    for (int i = 0; i <= steps; ++i)
      for (int j = 0; i + j <= steps; ++j) {
        const double u = static_cast<double>(i) / steps, v = static_cast<double>(j) / steps;
        const glm::dvec3 p = (1.0 - u - v) * a + u * b + v * c;
        missed +=
            std::none_of(boxes[t].begin(), boxes[t].end(), [&](const Box& x) { return holds(x, p, slack); });
      }
  }
  EXPECT_EQ(missed, 0u);
}

class BuilderTest : public ::testing::TestWithParam<std::tuple<BuildQuality, BvhTarget>> {
 protected:
  BvhTarget target() const { return std::get<1>(GetParam()); }
  BinaryBvh build(const CompiledScene& scene, std::size_t threads = 2) const {
    return buildBvh(scene, {std::get<0>(GetParam()), target(), threads});
  }
};

TEST_P(BuilderTest, RandomScenes_TreeIsSoundAndCoversEveryTriangle) {
  for (const CompiledScene& scene :
       {needles(3000, 1), test::randomSoup(5000, 0.1f, 2), test::sphere(24, 2.0f, {1, 2, 3}),
        test::box(6, {-1, -1, -1}, {1, 1, 1}, true)}) {
    const BinaryBvh bvh = build(scene);
    expectSound(bvh, target());
    expectCovered(bvh, scene, 1e-14);  // The sampled points are rounded.
  }
}

TEST_P(BuilderTest, AnyNumberOfThreads_GivesTheSameTree) {
  const CompiledScene scene = needles(40000, 7);
  const BinaryBvh one = build(scene, 1);
  for (const std::size_t threads : {2u, 3u, 8u}) {
    const BinaryBvh other = build(scene, threads);
    ASSERT_EQ(other.nodes.size(), one.nodes.size());
    EXPECT_EQ(std::memcmp(other.nodes.data(), one.nodes.data(), one.nodes.size() * sizeof(BinaryBvh::Node)),
              0);
    EXPECT_EQ(other.triangleOrder, one.triangleOrder);
  }
}

TEST_P(BuilderTest, OneTriangle_IsALeaf) {
  const CompiledScene scene = test::sceneOf({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}});
  const BinaryBvh bvh = build(scene);
  EXPECT_EQ(bvh.nodes.size(), 1u);
  expectSound(bvh, target());
  expectCovered(bvh, scene, 0.0);
}

TEST_P(BuilderTest, CoincidentTriangles_DepthStaysBounded) {
  const CompiledScene scene =
      test::sceneOf({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, std::vector<glm::uvec3>(30000, {0, 1, 2}));
  const BinaryBvh bvh = build(scene);
  expectSound(bvh, target());
  expectCovered(bvh, scene, 0.0);
  EXPECT_LE(bvh.depth, 16u);  // Median splits all the way: log2(30000), and the root.
}

TEST_P(BuilderTest, ExtremeExtents_TreeIsSound) {
  for (const float scale : {1e38f, 1e-38f, 1e-44f}) {
    CompiledScene scene = needles(500, 3);
    for (glm::vec3& p : scene.positions) p *= scale;
    const BinaryBvh bvh = build(scene);
    expectSound(bvh, target());
    expectCovered(bvh, scene, 1e-14 * static_cast<double>(scale));
  }
}

// Each triangle is ten times as far as the one before, so every split peels off one triangle.
TEST_P(BuilderTest, GeometricProgression_DepthStaysBounded) {
  std::vector<glm::vec3> positions;
  std::vector<glm::uvec3> triangles;
  for (int i = 0; i < 4000; ++i) {
    const float x = std::pow(1.04f, static_cast<float>(i % 2000) - 1500.0f);
    const auto first = static_cast<std::uint32_t>(positions.size());
    positions.insert(positions.end(), {{x, 0, 0}, {x, x, 0}, {x, 0, 0.1f * x}});
    triangles.push_back({first, first + 1, first + 2});
  }
  const CompiledScene scene = test::sceneOf(std::move(positions), std::move(triangles));
  expectSound(build(scene), target());
}

std::string buildName(const ::testing::TestParamInfo<std::tuple<BuildQuality, BvhTarget>>& test) {
  const auto [quality, target] = test.param;
  const std::string name = quality == BuildQuality::Fast       ? "Fast"
                           : quality == BuildQuality::Balanced ? "Balanced"
                                                               : "High";
  return name + (target == BvhTarget::Wide ? "Wide" : "Narrow");
}

INSTANTIATE_TEST_SUITE_P(Builds, BuilderTest,
                         ::testing::Combine(::testing::ValuesIn(qualities), ::testing::ValuesIn(targets)),
                         buildName);

/// A tree that splits by count along the longest axis, down to leaves of at most four triangles.
BinaryBvh medianTree(const CompiledScene& scene) {
  BinaryBvh bvh;
  std::vector<Reference> references = makeReferences(scene, 1);
  const std::function<std::uint32_t(std::size_t, std::size_t)> build = [&](std::size_t first,
                                                                           std::size_t last) {
    const auto slot = static_cast<std::uint32_t>(bvh.nodes.size());
    bvh.nodes.emplace_back();
    for (std::size_t i = first; i < last; ++i) bvh.nodes[slot].bounds.grow(references[i].box());
    if (last - first <= 4) {
      bvh.nodes[slot].first = static_cast<std::uint32_t>(bvh.triangleOrder.size());
      bvh.nodes[slot].count = static_cast<std::uint32_t>(last - first) & 0x7fffffffu;
      for (std::size_t i = first; i < last; ++i) bvh.triangleOrder.push_back(references[i].triangle());
      return slot;
    }
    const glm::vec3 extent = bvh.nodes[slot].bounds.upper - bvh.nodes[slot].bounds.lower;
    const int axis = extent.x > extent.y ? (extent.x > extent.z ? 0 : 2) : (extent.y > extent.z ? 1 : 2);
    const std::size_t middle = (first + last) / 2;
    const auto at = [&](std::size_t i) { return references.begin() + static_cast<std::ptrdiff_t>(i); };
    std::nth_element(at(first), at(middle), at(last), [axis](const Reference& a, const Reference& b) {
      return a.centre()[axis] < b.centre()[axis];
    });
    const std::uint32_t left = build(first, middle), right = build(middle, last);
    bvh.nodes[slot].left = left;
    bvh.nodes[slot].right = right;
    return slot;
  };
  build(0, references.size());
  return collapseToWide(bvh, {.node = 1.0, .leaf = 1.0}, 1);
}

TEST(Builder, Cost_FallsWithQuality) {
  for (const CompiledScene& scene : {needles(6000, 5), test::sphere(40, 1.0f, {})}) {
    const auto costOf = [&](BuildQuality quality) {
      return reportOf(buildBvh(scene, {quality, BvhTarget::Wide, 2}), scene.triangleCount()).sahCost;
    };
    const double median = reportOf(medianTree(scene), scene.triangleCount()).sahCost;
    EXPECT_LE(costOf(BuildQuality::High), costOf(BuildQuality::Balanced));
    EXPECT_LT(costOf(BuildQuality::Balanced), costOf(BuildQuality::Fast));
    EXPECT_LT(costOf(BuildQuality::Balanced), median);
  }
}

TEST(Builder, SpatialSplits_StayWithinTheirBudget) {
  const CompiledScene scene = needles(6000, 9);
  const auto report = reportOf(buildBvh(scene), scene.triangleCount());
  EXPECT_GT(report.duplicates, 0.02);
  EXPECT_LE(report.duplicates, 0.3);
  EXPECT_EQ(reportOf(buildBvh(scene, {BuildQuality::Balanced}), scene.triangleCount()).duplicates, 0.0);
}

/// Least cost of a subtree as a leaf or as a wide node, over all its partitions into at most eight parts.
double leastCost(const BinaryBvh& bvh, std::uint32_t root, const TraversalCosts& costs) {
  const std::function<std::uint32_t(std::uint32_t)> size = [&](std::uint32_t i) -> std::uint32_t {
    const BinaryBvh::Node& node = bvh.nodes[i];
    return node.count > 0 ? node.count : size(node.left) + size(node.right);
  };
  const BinaryBvh::Node& node = bvh.nodes[root];
  const double area = node.bounds.halfArea();
  double least = size(root) <= 8 ? area * costs.ofLeaf(size(root)) : std::numeric_limits<double>::infinity();
  if (node.count > 0) return least;
  using Cut = std::vector<std::uint32_t>;
  const std::function<std::vector<Cut>(std::uint32_t)> cuts = [&](std::uint32_t i) {
    std::vector<Cut> all{{i}};
    if (bvh.nodes[i].count > 0) return all;
    for (const Cut& left : cuts(bvh.nodes[i].left))
      for (const Cut& right : cuts(bvh.nodes[i].right)) {
        if (left.size() + right.size() > 8) continue;
        all.push_back(left);
        all.back().insert(all.back().end(), right.begin(), right.end());
      }
    return all;
  };
  for (const Cut& cut : cuts(root)) {
    if (cut.size() == 1) continue;
    double cost = area * costs.node;
    for (const std::uint32_t part : cut) cost += leastCost(bvh, part, costs);
    least = std::min(least, cost);
  }
  return least;
}

double costOf(const BinaryBvh& bvh, const TraversalCosts& costs) {
  double sum = 0.0;
  for (const BinaryBvh::Node& node : bvh.nodes)
    sum += node.bounds.halfArea() * (node.count > 0  ? costs.ofLeaf(node.count)
                                     : node.wideRoot ? costs.node
                                                     : 0.0);
  return sum;
}

TEST(Collapse, SmallTrees_CostIsTheLeastOfAllCuts) {
  for (std::uint32_t seed = 0; seed < 20; ++seed) {
    const CompiledScene scene = test::randomSoup(11, 0.4f, seed);
    for (const TraversalCosts& costs : {TraversalCosts{1.0, 1.0, 0.0}, TraversalCosts{0.2, 0.1, 0.5}}) {
      const BinaryBvh tree = buildTopDown(scene, {.leafSize = 1});
      const double least = leastCost(tree, 0, costs);
      EXPECT_NEAR(costOf(collapseToWide(tree, costs, 1), costs), least, 1e-12 * least);
    }
  }
}

TEST(ParallelPartition, AnySizeAndShare_SeparatesAsThePredicateSays) {
  std::mt19937 random(1);
  for (const std::size_t size : {0u, 1u, 100u, 32768u, 32769u, 200001u})
    for (const std::uint32_t share : {0u, 1u, 500u, 999u, 1000u}) {
      std::vector<std::uint32_t> items(size);
      for (auto& item : items) item = static_cast<std::uint32_t>(random());
      std::vector<std::uint32_t> expected = items;
      const auto goesLeft = [share](std::uint32_t x) { return x % 1000 < share; };
      const std::size_t left = parallelPartition(std::span(items), goesLeft, 3);
      EXPECT_EQ(left, static_cast<std::size_t>(std::count_if(expected.begin(), expected.end(), goesLeft)));
      EXPECT_TRUE(std::is_partitioned(items.begin(), items.end(), goesLeft));
      std::sort(items.begin(), items.end());
      std::sort(expected.begin(), expected.end());
      EXPECT_EQ(items, expected);
    }
}

/// Interleaves the bits of a cell's coordinates: x first, high bits first.
std::uint64_t interleaved(const glm::uvec3& cell) {
  std::uint64_t code = 0;
  for (int bit = 15; bit >= 0; --bit)
    for (int axis = 0; axis < 3; ++axis) code = code << 1 | (cell[axis] >> bit & 1u);
  return code;
}

// Triangles in cells of a grid with 2^16 cells per side; half of the triangles have another one in the next
// cell.
TEST(MortonTree, Triangles_AreInTheOrderOfTheirCodes) {
  std::mt19937 random(31);
  std::vector<glm::uvec3> cells{glm::uvec3(0), glm::uvec3(65535)};
  for (int i = 0; i < 2000; ++i) {
    const glm::uvec3 cell(random() % 65534, random() % 65534, random() % 65534);
    glm::uvec3 next = cell;
    next[static_cast<int>(random() % 3)] ^= 1u;
    cells.insert(cells.end(), {next, cell});
  }
  std::vector<glm::vec3> positions;
  std::vector<glm::uvec3> triangles;
  for (const glm::uvec3& cell : cells) {
    const auto first = static_cast<std::uint32_t>(positions.size());
    const glm::vec3 centre(cell);
    positions.insert(positions.end(), {centre - 0.125f, centre + 0.125f, centre + glm::vec3(0.125f, 0, 0)});
    triangles.push_back({first, first + 1, first + 2});
  }
  const BinaryBvh bvh = buildMortonTree(test::sceneOf(std::move(positions), std::move(triangles)), 2);
  ASSERT_EQ(bvh.triangleOrder.size(), cells.size());
  for (std::size_t i = 1; i < cells.size(); ++i)
    ASSERT_LE(interleaved(cells[bvh.triangleOrder[i - 1]]), interleaved(cells[bvh.triangleOrder[i]])) << i;
}

}  // namespace
}  // namespace prelight
