#include "occluders/occluder_cut.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <random>

#include "support/scenes.h"

namespace prelight {
namespace {

using ::testing::ElementsAre;

const std::vector<OccluderVector> allVectors = {
    OccluderVector::Position,       OccluderVector::Occlusion,     OccluderVector::Caustic,
    OccluderVector::Transmissive,   OccluderVector::DiffuseNormal, OccluderVector::DiffuseColor,
    OccluderVector::SpecularNormal, OccluderVector::SpecularColor};

/// `roots` complete binary trees with 2^depth leaves each, numbered level by level: roots, their children,
/// ...
OccluderTree completeTree(int roots, int depth) {
  OccluderTree tree;
  int first = 0;
  for (int level = 0; level <= depth; ++level) {
    const int count = roots << level;
    for (int i = 0; i < count; ++i) {
      const int below = first + count + 2 * i;
      tree.parent.push_back(level == 0 ? -1 : first - count / 2 + i / 2);
      tree.children.push_back(level == depth ? std::array{-1, -1} : std::array{below, below + 1});
      tree.names.push_back("tree node " + std::to_string(first + i));
    }
    first += count;
  }
  return tree;
}

std::vector<std::uint32_t> leafNodesOf(const OccluderTree& tree) {
  std::vector<std::uint32_t> leaves;
  for (std::uint32_t t = 0; t < tree.size(); ++t)
    if (tree.isLeaf(t)) leaves.push_back(t);
  return leaves;
}

OccluderTransfer emptyTransfer(const OccluderTree& tree, std::vector<OccluderVector> stored) {
  return {tree.names, std::move(stored), {0}, {}, {}};
}

/// Adds a record with an occlusion vector of random length; the other vectors are random as well.
void addRandomRecord(OccluderTransfer& transfer, std::uint32_t leaf, std::mt19937& random) {
  std::uniform_real_distribution<float> unit(0.0f, 1.0f);
  const float formFactor = 0.001f + 0.04f * unit(random) * unit(random);
  transfer.occluders.push_back(leaf);
  for (const OccluderVector vector : transfer.stored)
    transfer.vectors.push_back(
        vector == OccluderVector::Occlusion
            ? glm::vec4(formFactor * (0.8f + 0.2f * unit(random)) * test::randomDirection(random), formFactor)
            : glm::vec4(3.0f * test::randomDirection(random), unit(random)));
}

/// Every vertex sees about a third of the leaves; one in ten sees none.
OccluderTransfer randomTransfer(const OccluderTree& tree, std::size_t vertices, std::uint32_t seed,
                                std::vector<OccluderVector> stored = allVectors) {
  std::mt19937 random(seed);
  OccluderTransfer transfer = emptyTransfer(tree, std::move(stored));
  for (std::size_t v = 0; v < vertices; ++v) {
    for (const std::uint32_t leaf : leafNodesOf(tree))
      if (v % 10 != 9 && random() % 3 == 0) addRandomRecord(transfer, leaf, random);
    transfer.offsets.push_back(static_cast<std::uint32_t>(transfer.recordCount()));
  }
  return transfer;
}

std::vector<double> randomAreas(std::size_t vertices, std::uint32_t seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> area(0.01, 0.2);
  std::vector<double> areas;
  for (std::size_t v = 0; v < vertices; ++v) areas.push_back(area(random));
  return areas;
}

std::size_t columnOf(const OccluderTransfer& transfer, OccluderVector vector) {
  return static_cast<std::size_t>(std::find(transfer.stored.begin(), transfer.stored.end(), vector) -
                                  transfer.stored.begin());
}

glm::dvec4 vectorOf(const OccluderTransfer& transfer, std::size_t record, OccluderVector vector) {
  return transfer.vectors[record * transfer.stored.size() + columnOf(transfer, vector)];
}

double recordError(const glm::dvec4& occlusion) {
  const double length = glm::length(glm::dvec3(occlusion));
  return occlusion.w * std::sqrt(std::max(0.0, 1.0 - length / occlusion.w));
}

/// Area-weighted sum of the records' errors.
double errorOf(const OccluderTransfer& transfer, const std::vector<double>& areas) {
  double sum = 0.0;
  for (std::size_t v = 0; v < areas.size(); ++v)
    for (std::size_t r = transfer.offsets[v]; r < transfer.offsets[v + 1]; ++r)
      sum += areas[v] * recordError(vectorOf(transfer, r, OccluderVector::Occlusion));
  return sum;
}

double meanRecords(const OccluderTransfer& transfer) {
  return double(transfer.recordCount()) / double(transfer.offsets.size() - 1);
}

bool isAtOrBelow(const OccluderTree& tree, std::uint32_t node, std::uint32_t top) {
  int at = static_cast<int>(node);
  while (at > static_cast<int>(top)) at = tree.parent[static_cast<std::size_t>(at)];
  return at == static_cast<int>(top);
}

/// Leaf records of a vertex that are joined into its record for the node `top`.
std::vector<std::size_t> recordsBelow(const OccluderTransfer& leaves, const OccluderTree& tree,
                                      std::size_t vertex, std::uint32_t top) {
  std::vector<std::size_t> records;
  for (std::size_t r = leaves.offsets[vertex]; r < leaves.offsets[vertex + 1]; ++r)
    if (isAtOrBelow(tree, leaves.occluders[r], top)) records.push_back(r);
  return records;
}

using Weight = std::optional<OccluderVector>;

/// Sum of a vector over records, or its mean weighted by the w of `meanBy`.
glm::dvec4 joined(const OccluderTransfer& leaves, const std::vector<std::size_t>& records,
                  OccluderVector vector, Weight meanBy = {}) {
  glm::dvec4 sum(0.0);
  double weight = 0.0;
  for (const std::size_t r : records) {
    const double own = meanBy ? vectorOf(leaves, r, *meanBy).w : 1.0;
    sum += own * vectorOf(leaves, r, vector);
    weight += own;
  }
  return meanBy ? sum / weight : sum;
}

void expectNear(const glm::dvec4& got, const glm::dvec4& expected, double tolerance) {
  for (int c = 0; c < 4; ++c) EXPECT_NEAR(got[c], expected[c], tolerance);
}

TEST(OccluderCut, MoreRecordsThanThereAre_GivesTheLeavesBack) {
  const OccluderTree tree = completeTree(3, 4);
  const OccluderTransfer leaves = randomTransfer(tree, 50, 1);
  const OccluderTransfer cut = cutOccluders(leaves, tree, randomAreas(50, 2), 1000.0);
  EXPECT_EQ(cut.names, tree.names);
  EXPECT_EQ(cut.stored, leaves.stored);
  EXPECT_EQ(cut.offsets, leaves.offsets);
  EXPECT_EQ(cut.occluders, leaves.occluders);
  EXPECT_EQ(cut.vectors, leaves.vectors);
}

// The directions agree, so that joining the leaves loses nothing.
TEST(OccluderCut, LeavesOfNoError_AreJoinedOnlyWhereTheyExceedTheLimit) {
  const OccluderTree tree = completeTree(1, 1);
  OccluderTransfer leaves = emptyTransfer(tree, {OccluderVector::Occlusion});
  leaves.offsets = {0, 2};
  leaves.occluders = {1, 2};
  leaves.vectors = {{0.0f, 0.25f, 0.0f, 0.25f}, {0.0f, 0.5f, 0.0f, 0.5f}};
  EXPECT_EQ(cutOccluders(leaves, tree, std::vector{1.0}, 2.0).vectors, leaves.vectors);
  const OccluderTransfer cut = cutOccluders(leaves, tree, std::vector{1.0}, 1.5);
  EXPECT_THAT(cut.occluders, ElementsAre(0u));
  EXPECT_THAT(cut.vectors, ElementsAre(glm::vec4(0.0f, 0.75f, 0.0f, 0.75f)));
}

TEST(OccluderCut, NoRecordsAllowed_GivesOneOfEveryRootThatIsSeen) {
  const OccluderTree tree = completeTree(4, 3);
  const OccluderTransfer leaves = randomTransfer(tree, 60, 3);
  const OccluderTransfer cut = cutOccluders(leaves, tree, randomAreas(60, 4), 0.0);
  const Weight formFactor = OccluderVector::Occlusion, mirrored = OccluderVector::SpecularNormal;
  const std::map<OccluderVector, Weight> weights = {
      {OccluderVector::Position, formFactor}, {OccluderVector::Occlusion, {}},
      {OccluderVector::Caustic, {}},          {OccluderVector::Transmissive, formFactor},
      {OccluderVector::DiffuseNormal, {}},    {OccluderVector::DiffuseColor, formFactor},
      {OccluderVector::SpecularNormal, {}},   {OccluderVector::SpecularColor, mirrored}};
  for (std::size_t v = 0; v < 60; ++v) {
    std::size_t seenRoots = 0;
    for (std::uint32_t root = 0; root < 4; ++root) {
      const std::vector<std::size_t> below = recordsBelow(leaves, tree, v, root);
      if (below.empty()) continue;
      ++seenRoots;
      const auto found =
          std::find_if(cut.occluders.begin() + cut.offsets[v], cut.occluders.begin() + cut.offsets[v + 1],
                       [&](std::uint32_t t) { return isAtOrBelow(tree, t, root); });
      ASSERT_NE(found, cut.occluders.begin() + cut.offsets[v + 1]);
      const auto record = static_cast<std::size_t>(found - cut.occluders.begin());
      for (const auto& [vector, by] : weights)
        expectNear(vectorOf(cut, record, vector), joined(leaves, below, vector, by), 1e-5);
    }
    EXPECT_EQ(cut.offsets[v + 1] - cut.offsets[v], seenRoots) << "vertex " << v;
  }
}

TEST(OccluderCut, Records_OfAnyCut_AreWhatTheLeavesBelowThemAddUpTo) {
  const OccluderTree tree = completeTree(2, 5);
  const OccluderTransfer leaves =
      randomTransfer(tree, 40, 5, {OccluderVector::Position, OccluderVector::Occlusion});
  const OccluderTransfer cut = cutOccluders(leaves, tree, randomAreas(40, 6), 7.0);
  for (std::size_t v = 0; v < 40; ++v) {
    std::size_t covered = 0;
    for (std::size_t r = cut.offsets[v]; r < cut.offsets[v + 1]; ++r) {
      EXPECT_TRUE(r == cut.offsets[v] || cut.occluders[r - 1] < cut.occluders[r]);
      const std::vector<std::size_t> below = recordsBelow(leaves, tree, v, cut.occluders[r]);
      ASSERT_FALSE(below.empty());
      covered += below.size();
      expectNear(vectorOf(cut, r, OccluderVector::Occlusion),
                 joined(leaves, below, OccluderVector::Occlusion), 1e-6);
      expectNear(vectorOf(cut, r, OccluderVector::Position),
                 joined(leaves, below, OccluderVector::Position, OccluderVector::Occlusion), 1e-5);
    }
    EXPECT_EQ(covered, leaves.offsets[v + 1] - leaves.offsets[v]) << "vertex " << v;
  }
}

TEST(OccluderCut, FormFactors_OfEveryVertex_AddUpToWhatTheyDid) {
  const OccluderTree tree = completeTree(3, 5);
  const OccluderTransfer leaves = randomTransfer(tree, 100, 7, {OccluderVector::Occlusion});
  const auto sumOf = [](const OccluderTransfer& transfer, std::size_t v) {
    double sum = 0.0;
    for (std::size_t r = transfer.offsets[v]; r < transfer.offsets[v + 1]; ++r)
      sum += vectorOf(transfer, r, OccluderVector::Occlusion).w;
    return sum;
  };
  for (const double limit : {0.0, 5.0, 12.0, 100.0}) {
    const OccluderTransfer cut = cutOccluders(leaves, tree, randomAreas(100, 8), limit);
    for (std::size_t v = 0; v < 100; ++v) EXPECT_NEAR(sumOf(cut, v), sumOf(leaves, v), 1e-6);
  }
}

// Bisection comes close to the limit in a random scene, too.
TEST(OccluderCut, MeanRecords_AreWithinTheLimitAndCloseToIt) {
  const OccluderTree tree = completeTree(2, 6);
  const OccluderTransfer leaves = randomTransfer(tree, 200, 9);
  const std::vector<double> areas = randomAreas(200, 10);
  ASSERT_GT(meanRecords(leaves), 30.0);
  for (const double limit : {2.0, 3.5, 8.0, 16.0, 25.0, 35.0}) {
    const double records = meanRecords(cutOccluders(leaves, tree, areas, limit));
    EXPECT_LE(records, limit);
    EXPECT_GT(records, limit - 0.1);
  }
}

TEST(OccluderCut, Error_FallsWithTheRecords) {
  const OccluderTree tree = completeTree(2, 6);
  const OccluderTransfer leaves = randomTransfer(tree, 100, 11);
  const std::vector<double> areas = randomAreas(100, 12);
  double previous = errorOf(cutOccluders(leaves, tree, areas, 0.0), areas);
  for (const double limit : {3.0, 5.0, 8.0, 12.0, 18.0, 25.0, 32.0}) {
    const double error = errorOf(cutOccluders(leaves, tree, areas, limit), areas);
    EXPECT_LT(error, previous) << limit << " records";
    previous = error;
  }
  EXPECT_LT(errorOf(leaves, areas), previous);
}

/// All cuts of the tree below `top` as (records, error), from the occlusion vectors of the nodes.
std::vector<std::pair<int, double>> cutsBelow(const OccluderTree& tree, const std::vector<glm::dvec4>& nodes,
                                              std::uint32_t top) {
  std::vector<std::pair<int, double>> cuts = {{1, recordError(nodes[top])}};
  if (tree.isLeaf(top)) return cuts;
  for (const auto& a : cutsBelow(tree, nodes, static_cast<std::uint32_t>(tree.children[top][0])))
    for (const auto& b : cutsBelow(tree, nodes, static_cast<std::uint32_t>(tree.children[top][1])))
      cuts.emplace_back(a.first + b.first, a.second + b.second);
  return cuts;
}

// Compares with all 26 cuts of a tree of eight leaves, vertex by vertex.
TEST(OccluderCut, CutOfAVertex_HasTheLeastErrorOfAllCutsOfItsSize) {
  const OccluderTree tree = completeTree(1, 3);
  std::mt19937 random(13);
  int joins = 0;
  for (int trial = 0; trial < 50; ++trial) {
    OccluderTransfer leaves = emptyTransfer(tree, {OccluderVector::Occlusion});
    std::vector<glm::dvec4> nodes(tree.size(), glm::dvec4(0.0));
    for (const std::uint32_t leaf : leafNodesOf(tree)) {
      addRandomRecord(leaves, leaf, random);
      for (int t = static_cast<int>(leaf); t >= 0; t = tree.parent[static_cast<std::size_t>(t)])
        nodes[static_cast<std::size_t>(t)] += glm::dvec4(leaves.vectors.back());
    }
    leaves.offsets.push_back(8);
    const auto cuts = cutsBelow(tree, nodes, 0);
    ASSERT_EQ(cuts.size(), 26u);
    for (int limit = 1; limit <= 8; ++limit) {
      const OccluderTransfer cut = cutOccluders(leaves, tree, std::vector{1.0}, limit);
      const double error = errorOf(cut, {1.0});
      const int records = static_cast<int>(cut.recordCount());
      joins += records < 8 && records > 1;
      EXPECT_LE(records, limit);
      for (const auto& [otherRecords, otherError] : cuts)
        EXPECT_TRUE(otherRecords > records || error <= otherError + 1e-7);
    }
  }
  EXPECT_GT(joins, 100);
}

/// Adds a vertex with eight leaf records of the same form factor, `angle` radians from +Y.
void addFan(OccluderTransfer& transfer, const OccluderTree& tree, float angle) {
  int i = 0;
  for (const std::uint32_t leaf : leafNodesOf(tree)) {
    const float around = 0.7853982f * static_cast<float>(i++);
    const glm::vec3 direction(std::sin(angle) * std::cos(around), std::cos(angle),
                              std::sin(angle) * std::sin(around));
    transfer.occluders.push_back(leaf);
    transfer.vectors.push_back({0.05f * 0.999f * direction, 0.05f});
  }
  transfer.offsets.push_back(static_cast<std::uint32_t>(transfer.recordCount()));
}

TEST(OccluderCut, WideOccluder_KeepsMoreRecordsThanANarrowOne) {
  const OccluderTree tree = completeTree(1, 3);
  OccluderTransfer leaves = emptyTransfer(tree, {OccluderVector::Occlusion});
  addFan(leaves, tree, 0.05f);
  addFan(leaves, tree, 1.0f);
  for (const double limit : {2.0, 3.0, 4.5}) {
    const OccluderTransfer cut = cutOccluders(leaves, tree, std::vector{1.0, 1.0}, limit);
    EXPECT_GT(cut.offsets[2] - cut.offsets[1], cut.offsets[1]) << limit << " records";
  }
}

TEST(OccluderCut, VertexOfLargerArea_KeepsMoreRecords) {
  const OccluderTree tree = completeTree(1, 3);
  OccluderTransfer leaves = emptyTransfer(tree, {OccluderVector::Occlusion});
  addFan(leaves, tree, 0.5f);
  addFan(leaves, tree, 0.5f);
  const OccluderTransfer cut = cutOccluders(leaves, tree, std::vector{0.1, 1.9}, 4.5);
  EXPECT_GT(cut.offsets[2] - cut.offsets[1], cut.offsets[1]);
}

// One vertex is far larger than the mean: an error above 1 still counts.
TEST(OccluderCut, VertexOfVeryLargeArea_IsJoinedWhereTheLimitAsksForIt) {
  const OccluderTree tree = completeTree(1, 3);
  OccluderTransfer leaves = emptyTransfer(tree, {OccluderVector::Occlusion});
  std::vector<double> areas(100, 1e-6);
  for (int v = 0; v < 100; ++v) addFan(leaves, tree, 1.2f);
  areas[50] = 1.0;
  EXPECT_EQ(cutOccluders(leaves, tree, areas, 1.0).recordCount(), 100u);
  const OccluderTransfer cut = cutOccluders(leaves, tree, areas, 1.07);
  EXPECT_EQ(cut.recordCount(), 107u);
  EXPECT_EQ(cut.offsets[51] - cut.offsets[50], 8u);
}

TEST(OccluderCut, NodeOfWhichOneLeafIsSeen_StaysThatLeaf) {
  const OccluderTree tree = completeTree(2, 3);  // Leaves are 14 to 29.
  OccluderTransfer leaves = emptyTransfer(tree, allVectors);
  std::mt19937 random(17);
  for (const std::uint32_t leaf : {15u, 24u, 25u, 16u}) {
    addRandomRecord(leaves, leaf, random);
    if (leaf != 24u) leaves.offsets.push_back(static_cast<std::uint32_t>(leaves.recordCount()));
  }
  const OccluderTransfer cut = cutOccluders(leaves, tree, std::vector{1.0, 1.0, 1.0}, 0.0);
  EXPECT_THAT(cut.offsets, ElementsAre(0u, 1u, 2u, 3u));
  // Node 11 is above leaves 24 and 25; no record of its parents would see more.
  EXPECT_THAT(cut.occluders, ElementsAre(15u, 11u, 16u));
  for (std::size_t s = 0; s < allVectors.size(); ++s) {
    EXPECT_EQ(cut.vectors[s], leaves.vectors[s]);
    EXPECT_EQ(cut.vectors[2 * allVectors.size() + s], leaves.vectors[3 * allVectors.size() + s]);
  }
}

TEST(OccluderCut, RowsWithoutRecords_StayEmpty) {
  const OccluderTree tree = completeTree(2, 4);
  const OccluderTransfer leaves = randomTransfer(tree, 100, 19);
  for (const double limit : {0.0, 4.0, 100.0}) {
    const OccluderTransfer cut = cutOccluders(leaves, tree, randomAreas(100, 20), limit);
    for (std::size_t v = 9; v < 100; v += 10) EXPECT_EQ(cut.offsets[v], cut.offsets[v + 1]);
  }
  EXPECT_EQ(cutOccluders(emptyTransfer(tree, allVectors), tree, {}, 4.0).recordCount(), 0u);
}

TEST(OccluderCut, RecordsWithoutFormFactor_AreLeftOut) {
  const OccluderTree tree = completeTree(1, 1);
  OccluderTransfer leaves = emptyTransfer(tree, {OccluderVector::Position, OccluderVector::Occlusion});
  leaves.offsets = {0, 2};
  leaves.occluders = {1, 2};
  leaves.vectors = {glm::vec4(1.0f), glm::vec4(0.0f), glm::vec4(2.0f), {0.0f, 0.25f, 0.0f, 0.25f}};
  const OccluderTransfer cut = cutOccluders(leaves, tree, std::vector{1.0}, 0.0);
  EXPECT_THAT(cut.occluders, ElementsAre(2u));
  EXPECT_THAT(cut.vectors, ElementsAre(leaves.vectors[2], leaves.vectors[3]));
}

TEST(OccluderCut, AreasThatAreAllZero_CountAlike) {
  const OccluderTree tree = completeTree(2, 4);
  const OccluderTransfer leaves = randomTransfer(tree, 30, 21);
  const OccluderTransfer none = cutOccluders(leaves, tree, std::vector<double>(30, 0.0), 5.0);
  const OccluderTransfer alike = cutOccluders(leaves, tree, std::vector<double>(30, 0.3), 5.0);
  EXPECT_EQ(none.offsets, alike.offsets);
  EXPECT_EQ(none.occluders, alike.occluders);
}

TEST(OccluderCut, SameRecords_GiveTheSameCut) {
  const OccluderTree tree = completeTree(2, 6);
  const OccluderTransfer leaves = randomTransfer(tree, 300, 23);
  const std::vector<double> areas = randomAreas(300, 24);
  const OccluderTransfer a = cutOccluders(leaves, tree, areas, 6.0),
                         b = cutOccluders(leaves, tree, areas, 6.0);
  EXPECT_EQ(a.offsets, b.offsets);
  EXPECT_EQ(a.occluders, b.occluders);
  EXPECT_EQ(a.vectors, b.vectors);
}

// Tree and cut together: records of clusters of a scene, as seen from a point, are joined by the clusters'
// positions.
TEST(OccluderCut, LeavesOfASceneTree_JoinToItsNodes) {
  CompiledScene scene = test::sphere(8, 0.5f, {0.0f, 2.0f, 0.0f});
  test::append(scene, test::ground(8, 2.0f, 1.0f));
  const OccluderTree tree = makeOccluderTree(scene, 32);
  std::mt19937 random(25);
  OccluderTransfer leaves = emptyTransfer(tree, {OccluderVector::Occlusion});
  for (const std::uint32_t leaf : leafNodesOf(tree)) addRandomRecord(leaves, leaf, random);
  leaves.offsets.push_back(static_cast<std::uint32_t>(leaves.recordCount()));
  const OccluderTransfer cut = cutOccluders(leaves, tree, std::vector{1.0}, 2.0);
  EXPECT_THAT(cut.occluders, ElementsAre(0u, 1u));
  EXPECT_THAT(cut.names, ::testing::Contains("node 1/0"));
}

}  // namespace
}  // namespace prelight
