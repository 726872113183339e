// Solids that stick into one another: surface inside another solid does not darken visible surface beside it.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <random>

#include "oracle/brute_force.h"
#include "support/run_bake.h"
#include "support/scenes.h"

namespace prelight {
namespace {

/// A block, and a bar that enters one side of it and comes out at the other.
CompiledScene blockAndBar() {
  CompiledScene scene = test::box(5, {-0.5f, -0.5f, -0.5f}, {0.5f, 0.5f, 0.5f}, false);
  test::append(scene, test::box(5, {-0.13f, -0.17f, -0.9f}, {0.21f, 0.15f, 0.9f}, false));
  return scene;
}

bool isInBar(const glm::dvec3& p) { return p.x > -0.13 && p.x < 0.21 && p.y > -0.17 && p.y < 0.15; }
bool isInBlock(const glm::dvec3& p) { return std::abs(p.z) < 0.5; }

BakeRequest aoRequest() {
  BakeRequest request;
  request.ao = true;
  request.effort.rays = 512;
  return request;
}

/// Cosine-weighted share of the hemisphere that is open.
double openness(const CompiledScene& scene, std::uint32_t triangle, const glm::dvec3& p,
                std::mt19937& random) {
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  const glm::dvec3 n = glm::normalize(geometricNormal(scene, triangle));
  constexpr int rays = 144;
  int open = 0;
  for (int i = 0; i < rays; ++i) {
    const double z = 2.0 * (i + unit(random)) / rays - 1.0, turn = 6.283185307179586 * unit(random);
    const glm::dvec3 ball(std::sqrt(1.0 - z * z) * std::cos(turn), std::sqrt(1.0 - z * z) * std::sin(turn),
                          z);
    open += reference::closestHit(scene, p + 1e-6 * n, n + 0.9999 * ball, 1e9, triangle) ? 0 : 1;
  }
  return double(open) / rays;
}

/// Root mean square error of AO over the visible parts of triangles that another surface cuts.
double errorWhereCut(const CompiledScene& scene, const std::vector<float>& ao) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  double sum = 0.0;
  int count = 0;
  for (std::uint32_t t = 0; t < scene.triangleCount(); ++t) {
    const bool ofBlock = t < scene.primitives[1].firstTriangle;
    // The bar meets only the two faces across z.
    if (ofBlock && std::abs(geometricNormal(scene, t).z) < 1e-6) continue;
    const glm::uvec3 corners = scene.triangles[t];
    std::vector<std::pair<double, glm::dvec3>> seen;
    bool hides = false;
    for (int i = 0; i < 12; ++i) {
      double u = unit(random), v = unit(random);
      if (u + v > 1.0) u = 1.0 - u, v = 1.0 - v;
      const double w = 1.0 - u - v;
      const glm::dvec3 p = w * glm::dvec3(scene.positions[corners.x]) +
                           u * glm::dvec3(scene.positions[corners.y]) +
                           v * glm::dvec3(scene.positions[corners.z]);
      const bool hidden = ofBlock ? isInBar(p) : isInBlock(p);
      hides = hides || hidden;
      if (!hidden) seen.emplace_back(w * ao[corners.x] + u * ao[corners.y] + v * ao[corners.z], p);
    }
    for (const auto& [baked, p] : seen) {
      if (!hides) break;
      const double error = baked - openness(scene, t, p, random);
      sum += error * error;
      ++count;
    }
  }
  EXPECT_GT(count, 100);
  return std::sqrt(sum / count);
}

TEST(EnteredSolids, VertexAoBesideThem_IsThatOfWhatIsSeen) {
  CompiledScene scene = blockAndBar();
  const double error = errorWhereCut(scene, test::runBake(scene, aoRequest()).bake.ao);
  EXPECT_LT(error, 0.06);  // The reference's own noise is 0.03 of it.
  // The inside of two-sided objects may be looked at: receivers there keep their weight, and darken.
  for (CompiledMaterial& material : scene.materials) material.doubleSided = true;
  EXPECT_GT(errorWhereCut(scene, test::runBake(scene, aoRequest()).bake.ao), 2.0 * error);
}

/// AO alone needs any hit, bounces need the closest. Both find the same hidden places.
TEST(EnteredSolids, ClosestHitsAndAny_TellTheSame) {
  const CompiledScene scene = blockAndBar();
  BakeRequest request = aoRequest();
  const std::vector<float> any = test::runBake(scene, request).bake.ao;
  request.sh.order = 2;
  request.bounces = 1;
  const std::vector<float> closest = test::runBake(scene, request).bake.ao;
  ASSERT_EQ(any.size(), closest.size());
  double sum = 0.0;
  for (std::size_t v = 0; v < any.size(); ++v) sum += std::pow(double(any[v]) - double(closest[v]), 2.0);
  EXPECT_LT(std::sqrt(sum / double(any.size())), 0.02);  // Bounces do without thinning.
}

/// A body wholly inside another has only its own receivers to determine its values: it stays dark.
TEST(EnteredSolids, BodyThatNobodySees_StaysDark) {
  CompiledScene scene = test::box(2, glm::vec3(-1.0f), glm::vec3(1.0f), false);
  test::append(scene, test::box(2, glm::vec3(-0.3f), glm::vec3(0.3f), false));
  const std::vector<float> ao = test::runBake(scene, aoRequest()).bake.ao;
  for (std::uint32_t v = 0; v < scene.vertexCount(); ++v)
    EXPECT_NEAR(ao[v], v < scene.primitives[1].firstVertex ? 1.0f : 0.0f, 1e-3f) << v;
}

}  // namespace
}  // namespace prelight
