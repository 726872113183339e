#include "occluders/occluder_tree.h"

#include <gmock/gmock.h>

#include <set>

#include "scene/deform.h"
#include "support/scenes.h"

namespace prelight {
namespace {

using ::testing::ElementsAre;
using ::testing::StartsWith;

/// Makes all primitives of a scene primitives of one node.
CompiledScene asOneNode(CompiledScene scene) {
  for (PrimitiveRange& range : scene.primitives) range.node = 0;
  return scene;
}

/// Node 0 is a ground, node 1 a sphere, node 2 a box.
CompiledScene groundSphereBox() {
  CompiledScene scene = test::ground(8, 2.0f);
  test::append(scene, test::sphere(8, 0.5f, {0.0f, 0.8f, 0.0f}));
  test::append(scene, test::box(3, {0.8f, 0.2f, -0.4f}, {1.4f, 0.9f, 0.4f}, false));
  return scene;
}

std::uint32_t rootOf(const OccluderTree& tree, std::uint32_t node) {
  while (tree.parent[node] >= 0) node = static_cast<std::uint32_t>(tree.parent[node]);
  return node;
}

std::set<std::uint32_t> leavesOf(const OccluderTree& tree, const PrimitiveRange& range) {
  const auto first = tree.leafOfVertex.begin() + range.firstVertex;
  return {first, first + range.vertexCount};
}

TEST(OccluderTree, Leaves_OfSeveralNodes_PartitionTheVertices) {
  const CompiledScene scene = groundSphereBox();
  const OccluderTree tree = makeOccluderTree(scene, 20);
  ASSERT_EQ(tree.leafOfVertex.size(), scene.vertexCount());
  std::vector<int> vertices(tree.size(), 0);
  for (std::uint32_t v = 0; v < scene.vertexCount(); ++v) {
    ASSERT_LT(tree.leafOfVertex[v], tree.size());
    ++vertices[tree.leafOfVertex[v]];
    const std::uint32_t node = v < scene.primitives[1].firstVertex   ? 0
                               : v < scene.primitives[2].firstVertex ? 1
                                                                     : 2;
    EXPECT_EQ(rootOf(tree, tree.leafOfVertex[v]), node) << "vertex " << v;
  }
  for (std::uint32_t t = 0; t < tree.size(); ++t)
    EXPECT_EQ(vertices[t] > 0, tree.isLeaf(t)) << "tree node " << t;
}

TEST(OccluderTree, Parents_OfEveryNode_ComeFirstAndKnowTheirChildren) {
  const OccluderTree tree = makeOccluderTree(groundSphereBox(), 40);
  ASSERT_EQ(tree.size(), 3u + 2u * 37u);
  ASSERT_EQ(tree.parent.size(), tree.size());
  ASSERT_EQ(tree.children.size(), tree.size());
  for (std::size_t t = 0; t < tree.size(); ++t) {
    EXPECT_EQ(tree.parent[t] < 0, t < 3);
    EXPECT_LT(tree.parent[t], static_cast<int>(t));
    for (std::size_t k = 0; k < 2 && tree.children[t][0] >= 0; ++k) {
      const auto child = static_cast<std::size_t>(tree.children[t][k]);
      EXPECT_EQ(tree.parent[child], static_cast<int>(t));
      EXPECT_EQ(tree.names[child], tree.names[t] + (k == 0 ? "/0" : "/1"));
    }
  }
  EXPECT_EQ(tree.names[0], "node 0");
}

TEST(OccluderTree, Leaves_AreAsManyAsAskedFor) {
  const CompiledScene scene = groundSphereBox();
  for (const std::size_t leaves : {3u, 4u, 17u, 64u, 200u})
    EXPECT_EQ(makeOccluderTree(scene, leaves).leafCount(), leaves);
}

TEST(OccluderTree, MoreNodesThanLeaves_AreNotSplit) {
  const OccluderTree tree = makeOccluderTree(groundSphereBox(), 2);
  EXPECT_THAT(tree.names, ElementsAre("node 0", "node 1", "node 2"));
  EXPECT_THAT(tree.parent, ElementsAre(-1, -1, -1));
  for (std::uint32_t t = 0; t < 3; ++t) EXPECT_TRUE(tree.isLeaf(t));
}

// The second blob lies along -x of the first. The split axis has a positive largest component, so that the
// second blob's projection is below the mean.
TEST(OccluderTree, TwoBlobsOfANode_AreSetApartFirst) {
  CompiledScene scene = test::sphere(8, 0.5f, {3.0f, 0.0f, 0.0f});
  test::append(scene, test::sphere(6, 0.5f, {-3.0f, 0.2f, 0.1f}));
  scene = asOneNode(scene);
  const OccluderTree tree = makeOccluderTree(scene, 2);
  EXPECT_THAT(tree.names, ElementsAre("node 0", "node 0/0", "node 0/1"));
  EXPECT_THAT(leavesOf(tree, scene.primitives[0]), ElementsAre(2u));
  EXPECT_THAT(leavesOf(tree, scene.primitives[1]), ElementsAre(1u));
}

TEST(OccluderTree, NodeThatIsWider_IsSplitBeforeOthers) {
  CompiledScene scene = test::sphere(8, 0.5f, {0.0f, 0.8f, 0.0f});
  test::append(scene, test::ground(4, 2.0f));
  const OccluderTree tree = makeOccluderTree(scene, 6);
  ASSERT_EQ(tree.leafCount(), 6u);
  for (std::size_t t = 2; t < tree.size(); ++t) EXPECT_THAT(tree.names[t], StartsWith("node 1/"));
}

// Among nodes of equal spread, the one with the lower id is split first.
TEST(OccluderTree, NodesOfOneSpread_AreSplitInTheirOrder) {
  CompiledScene scene = test::ground(4, 1.0f);
  test::append(scene, test::ground(4, 1.0f));
  EXPECT_EQ(makeOccluderTree(scene, 3).parent, (std::vector<int>{-1, -1, 0, 0}));
}

// A strip along x of 16 m2 whose right half has sixteen times as many vertices. Weighted by area, its middle
// is at 0.
TEST(OccluderTree, Split_IsWhereTheMeanOfTheAreaIs) {
  CompiledScene scene = test::ground(4, 2.0f);
  test::append(scene, test::ground(16, 2.0f));
  for (std::uint32_t v = 0; v < scene.vertexCount(); ++v)
    scene.positions[v].x += v < scene.primitives[0].vertexCount ? -2.0f : 2.0f;
  const OccluderTree tree = makeOccluderTree(asOneNode(scene), 2);
  for (std::uint32_t v = 0; v < scene.vertexCount(); ++v) {
    const float x = scene.positions[v].x;
    EXPECT_TRUE(x == 0.0f || tree.leafOfVertex[v] == (x < 0.0f ? 1u : 2u)) << "x = " << x;
  }
}

TEST(OccluderTree, CoincidentVertices_AreNotSplit) {
  const CompiledScene scene =
      test::sceneOf(std::vector<glm::vec3>(9, {0.1f, 0.7f, -0.3f}), {{0, 1, 2}, {3, 4, 5}, {6, 7, 8}});
  const OccluderTree tree = makeOccluderTree(scene, 8);
  EXPECT_THAT(tree.names, ElementsAre("node 0"));
  EXPECT_EQ(tree.leafOfVertex, std::vector<std::uint32_t>(9, 0));
}

// With two positions of three vertices each there can be no more than two leaves, one per position.
TEST(OccluderTree, CopiesOfAVertex_ShareALeaf) {
  const glm::vec3 a(0.1f, 0.7f, -0.3f), b(0.1f, 0.7f, 0.9f);
  const OccluderTree tree = makeOccluderTree(test::sceneOf({a, b, a, b, a, b}, {{0, 1, 2}, {3, 4, 5}}), 6);
  EXPECT_EQ(tree.leafOfVertex, (std::vector<std::uint32_t>{1, 2, 1, 2, 1, 2}));
}

TEST(OccluderTree, MoreLeavesThanPlaces_EndWithALeafAPlace) {
  const CompiledScene scene = test::sphere(6, 1.0f, {0.0f, 0.0f, 0.0f});
  const OccluderTree tree = makeOccluderTree(scene, 1000);
  EXPECT_EQ(tree.leafCount(), scene.vertexCount());
  EXPECT_EQ(std::set<std::uint32_t>(tree.leafOfVertex.begin(), tree.leafOfVertex.end()).size(),
            scene.vertexCount());
}

TEST(OccluderTree, SameScene_GivesTheSameTree) {
  const CompiledScene scene = test::randomSoup(300, 0.2f, 5);
  const OccluderTree a = makeOccluderTree(scene, 50), b = makeOccluderTree(scene, 50);
  EXPECT_EQ(a.names, b.names);
  EXPECT_EQ(a.parent, b.parent);
  EXPECT_EQ(a.children, b.children);
  EXPECT_EQ(a.leafOfVertex, b.leafOfVertex);
}

TEST(OccluderTree, VerticesWithoutTriangles_GoToTheFirstLeaf) {
  CompiledScene scene = test::sphere(6, 1.0f, {0.0f, 0.0f, 0.0f});
  const std::uint32_t drawn = scene.vertexCount();
  test::append(scene, test::sceneOf({{9.0f, 0.0f, 0.0f}, {9.0f, 1.0f, 0.0f}}, {}));
  const OccluderTree tree = makeOccluderTree(scene, 3);
  EXPECT_EQ(tree.names.size(), 5u);
  ASSERT_EQ(tree.leafOfVertex.size(), drawn + 2);
  for (std::uint32_t v = drawn; v < drawn + 2; ++v) {
    EXPECT_TRUE(tree.isLeaf(tree.leafOfVertex[v]));
    for (std::uint32_t t = 0; t < tree.leafOfVertex[v]; ++t) EXPECT_FALSE(tree.isLeaf(t));
  }
}

TEST(OccluderTree, SceneWithoutTriangles_HasNoNodes) {
  EXPECT_EQ(makeOccluderTree(CompiledScene(), 8).size(), 0u);
  const OccluderTree tree = makeOccluderTree(test::sceneOf({{0.0f, 0.0f, 0.0f}}, {}), 8);
  EXPECT_EQ(tree.size(), 0u);
  EXPECT_THAT(tree.leafOfVertex, ElementsAre(0u));
}

TEST(OccluderTree, VertexAreas_AddUpToTheSurface) {
  const std::vector<double> areas = surfaceOfVertices(test::ground(4, 2.0f));
  double sum = 0.0;
  for (const double area : areas) sum += area;
  EXPECT_NEAR(sum, 16.0, 1e-6);
  EXPECT_NEAR(areas[6], 1.0, 1e-6);            // Six triangles of 0.5 m2 meet inside.
  EXPECT_NEAR(areas[0], 2.0 * 0.5 / 3, 1e-6);  // Two triangles meet at this corner.
}

}  // namespace
}  // namespace prelight
