#include "refine/refined_mesh.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <random>
#include <tuple>

#include "support/scenes.h"

namespace prelight {
namespace {

/// A cube whose sides are six primitives with vertices of their own: edges are shared by position alone.
Mesh cubeOfSides() {
  const CompiledScene cube = test::box(1, glm::vec3(0.0f), glm::vec3(1.0f), false);
  Mesh mesh;
  for (std::size_t t = 0; t < cube.triangles.size(); t += 2) {
    Primitive& side = mesh.primitives.emplace_back();
    for (std::size_t k = t; k < t + 2; ++k) {
      const auto first = static_cast<std::uint32_t>(side.positions.size());
      for (int c = 0; c < 3; ++c) side.positions.push_back(cube.positions[cube.triangles[k][c]]);
      side.triangles.emplace_back(first, first + 1, first + 2);
    }
  }
  return mesh;
}

constexpr double longestOnly = std::numeric_limits<double>::infinity();

/// Cuts randomly chosen parts, a few times.
RefinedMesh cutAtRandom(const Mesh& mesh, int times, std::uint32_t seed) {
  RefinedMesh refined(mesh, 0, glm::dmat3(1.0));
  std::mt19937 random(seed);
  for (int i = 0; i < times; ++i) {
    RefinedMesh::Edges edges;
    for (const TrianglePart& part : refined.parts())
      if (random() % 4 == 0) refined.mark(part, random() % 2 == 0 ? 0.0 : longestOnly, edges);
    refined.close(edges);
    refined.cut(edges);
  }
  return refined;
}

/// The positions that a reader of the refined primitive has, [vertex].
std::vector<glm::vec3> positionsOf(const Mesh& mesh, const RefinedPrimitive& refined) {
  std::vector<glm::vec3> positions = mesh.primitives[refined.primitive].positions;
  for (const auto& [a, b] : refined.added) positions.push_back(middleOf(positions[a], positions[b]));
  return positions;
}

using Point = std::tuple<float, float, float>;

Point pointOf(const glm::vec3& v) { return {v.x, v.y, v.z}; }

TEST(RefinedMesh, EdgesOfAClosedSurface_StayBetweenTwoTriangles) {
  const Mesh mesh = cubeOfSides();
  std::map<std::pair<Point, Point>, int> uses;  // by position, in both directions
  std::size_t triangles = 0;
  for (const RefinedPrimitive& primitive : cutAtRandom(mesh, 6, 1).refined()) {
    const std::vector<glm::vec3> positions = positionsOf(mesh, primitive);
    for (const glm::uvec3& t : primitive.triangles)
      for (int c = 0; c < 3; ++c) ++uses[{pointOf(positions[t[c]]), pointOf(positions[t[(c + 1) % 3]])}];
    triangles += primitive.triangles.size();
  }
  ASSERT_GT(triangles, 500u);
  for (const auto& [edge, count] : uses) {
    EXPECT_EQ(count, 1);
    EXPECT_EQ(uses.count({edge.second, edge.first}), 1u) << "a crack";
  }
}

TEST(RefinedMesh, Area_IsThatOfTheMesh) {
  const Mesh mesh = cubeOfSides();
  const RefinedMesh refined = cutAtRandom(mesh, 6, 2);
  double area = 0.0;
  for (const TrianglePart& part : refined.parts()) area += refined.area(part);
  // Corners of the unit cube's parts are exact in floats.
  EXPECT_NEAR(area, 6.0, 1e-12);
}

TEST(RefinedMesh, WeightsOfParts_LeadToTheirVertices) {
  const Mesh mesh = cubeOfSides();
  const RefinedMesh refined = cutAtRandom(mesh, 5, 3);
  std::map<std::size_t, std::vector<glm::vec3>> positions;
  for (const RefinedPrimitive& primitive : refined.refined())
    positions[primitive.primitive] = positionsOf(mesh, primitive);
  for (const TrianglePart& part : refined.parts()) {
    const Primitive& primitive = mesh.primitives[part.primitive];
    const glm::uvec3 root = primitive.triangles[part.root];
    const glm::dvec3 a(primitive.positions[root.x]), b(primitive.positions[root.y]),
        c(primitive.positions[root.z]);
    for (std::size_t k = 0; k < 3; ++k) {
      const glm::dvec3 expected = a + part.weights[k].x * (b - a) + part.weights[k].y * (c - a);
      const auto found = positions.find(part.primitive);
      const glm::dvec3 got((found == positions.end() ? primitive.positions : found->second)[part.corners[k]]);
      EXPECT_LT(glm::length(got - expected), 1e-6);
    }
  }
}

/// Cutting the longest edge first leaves at least half of the smallest angle (Rosenberg and Stenger 1975).
TEST(RefinedMesh, Angles_DoNotDegenerate) {
  Mesh mesh;
  Primitive& primitive = mesh.primitives.emplace_back();
  primitive.positions = {{0, 0, 0}, {1, 0, 0}, {0.4f, 0.7f, 0}};
  primitive.triangles = {{0, 1, 2}};
  const double smallest = std::acos(glm::dot(glm::normalize(glm::dvec2(0.4, 0.7)), glm::dvec2(1, 0)));
  RefinedMesh refined(mesh, 0, glm::dmat3(1.0));
  for (int i = 0; i < 8; ++i) {
    RefinedMesh::Edges edges;
    refined.mark(refined.parts().front(), i % 2 == 0 ? 0.0 : longestOnly, edges);  // a corner, ever smaller
    refined.close(edges);
    refined.cut(edges);
  }
  const std::vector<glm::vec3> positions = positionsOf(mesh, refined.refined().front());
  for (const TrianglePart& part : refined.parts())
    for (std::size_t k = 0; k < 3; ++k) {
      const glm::dvec3 at(positions[part.corners[k]]);
      const glm::dvec3 u = glm::normalize(glm::dvec3(positions[part.corners[(k + 1) % 3]]) - at),
                       v = glm::normalize(glm::dvec3(positions[part.corners[(k + 2) % 3]]) - at);
      EXPECT_GT(std::acos(glm::dot(u, v)), 0.4 * std::min(smallest, std::acos(0.0) - smallest));
    }
}

TEST(RefinedMesh, Sliver_IsCutAtEdgesThatAreLongEnough) {
  Mesh mesh;
  Primitive& primitive = mesh.primitives.emplace_back();
  primitive.positions = {{0, 0, 0}, {1, 0, 0}, {0, 0.001f, 0}};
  primitive.triangles = {{0, 1, 2}};
  const RefinedMesh refined(mesh, 0, glm::dmat3(1.0));
  RefinedMesh::Edges edges;
  refined.mark(refined.parts().front(), 0.01, edges);
  EXPECT_EQ(edges.size(), 2u);
}

TEST(RefinedMesh, Uncut_HasNoRefinedPrimitives) {
  EXPECT_TRUE(RefinedMesh(cubeOfSides(), 0, glm::dmat3(1.0)).refined().empty());
}

}  // namespace
}  // namespace prelight
