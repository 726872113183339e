#include "benchmarks/suites/visibility/direct_light.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "benchmarks/run/measure.h"
#include "benchmarks/scenes/probe_lights.h"
#include "support/devices.h"
#include "support/scenes.h"

namespace prelight::benchmarks {
namespace {

using std::numbers::pi;
constexpr float discRadius = 0.4f, discHeight = 0.5f;
constexpr double lightHeight = 2.0;

/// A ground of 2 m with a disc above its middle, both facing up.
CompiledScene discOverGround(int cells) {
  constexpr std::uint32_t segments = 128;
  std::vector<glm::vec3> positions = {{0.0f, discHeight, 0.0f}};
  std::vector<glm::uvec3> triangles;
  for (std::uint32_t i = 0; i < segments; ++i) {
    const double angle = 2.0 * pi * i / segments;
    positions.emplace_back(discRadius * std::cos(angle), discHeight, -discRadius * std::sin(angle));
    triangles.emplace_back(0, 1 + i, 1 + (i + 1) % segments);
  }
  CompiledScene scene = test::ground(cells, 1.0f);
  test::append(scene, test::sceneOf(positions, triangles));
  scene.boundsMin = {-1.0f, 0.0f, -1.0f};
  scene.boundsMax = {1.0f, discHeight, 1.0f};
  return scene;
}

/// The disc's shadow is one of radius R = r H / (H - h), and the cosine on the ground H / sqrt(H^2 + rho^2):
/// without shadows the mean square error is pi H^2 ln(1 + R^2 / H^2) over the area.
double errorWithoutShadows() {
  const double reach = discRadius * lightHeight / (lightHeight - discHeight);
  const double squares =
      pi * lightHeight * lightHeight * std::log1p(reach * reach / (lightHeight * lightHeight));
  return std::sqrt(squares / (4.0 + pi * discRadius * discRadius));
}

TEST(DirectLight, DiscOverGround_HasTheErrorOfItsShadow) {
  const CompiledScene scene = discOverGround(40);
  Tracer tracer(scene, test::sharedDevice());
  const DirectLight direct(scene, tracer, {{0.0, lightHeight, 0.0}}, 40000, 3);
  const double unshadowed = direct.error([](std::size_t, std::uint32_t) { return 1.0; });
  // 40 000 points: the share of 0.2 in the shadow has a standard error of 0.002, its root half of that,
  // relatively.
  EXPECT_NEAR(unshadowed / errorWithoutShadows(), 1.0, 0.02);
  // What is left is the shadow's edge, within a cell of its circumference.
  const double traced =
      direct.error([&](std::size_t light, std::uint32_t v) { return direct.tracedAtVertex(light, v); });
  EXPECT_LT(traced, 0.35 * unshadowed);
  EXPECT_GT(traced, 0.0);
}

TEST(DirectLight, TracedAtFinerVertices_IsCloserToTheTruth) {
  const auto traced = [](int cells) {
    const CompiledScene scene = discOverGround(cells);
    Tracer tracer(scene, test::sharedDevice());
    const DirectLight direct(scene, tracer, {{0.5, 2.0, 0.3}, {-0.7, 1.5, 0.0}}, 10000, 3);
    return direct.error([&](std::size_t light, std::uint32_t v) { return direct.tracedAtVertex(light, v); });
  };
  // The band in error is as wide as a cell: a quarter of the width is half of the root mean square.
  EXPECT_NEAR(traced(64) / traced(16), 0.5, 0.1);
}

TEST(DirectLight, PointsInsideSolids_DoNotCount) {
  constexpr double radius = 0.45;
  CompiledScene scene = test::ground(16, 1.0f);
  test::append(scene, test::sphere(48, static_cast<float>(radius), glm::vec3(0.0f)));
  scene.boundsMin = {-1.0f, -radius, -1.0f};
  scene.boundsMax = {1.0f, radius, 1.0f};
  Tracer tracer(scene, test::sharedDevice());
  constexpr std::size_t points = 40000;
  const DirectLight direct(scene, tracer, {{0.3, 2.0, 0.2}}, points, 3);
  // The ball hides a disc of the ground. 40 000 points: the share of 0.1 has a standard error of 0.0015.
  const double disc = pi * radius * radius;
  const double hidden = 1.0 - static_cast<double>(direct.sampleCount()) / points;
  EXPECT_NEAR(hidden, disc / (4.0 + 4.0 * disc), 0.006);
  // What vertices of the ground inside the ball hold is worth no error.
  const auto shown = [&](double inside) {
    return direct.error([&](std::size_t light, std::uint32_t v) {
      const glm::vec3& place = scene.positions[v];
      const bool hiddenVertex = place.y == 0.0f && glm::length(place) < radius - 0.2;
      return hiddenVertex ? inside : direct.tracedAtVertex(light, v);
    });
  };
  EXPECT_DOUBLE_EQ(shown(0.0), shown(1.0));
}

TEST(ProbeLights, Around_AreOutsideAtOneDistance) {
  const CompiledScene scene = discOverGround(2);
  const glm::dvec3 centre(0.0, 0.5 * discHeight, 0.0);
  const double diagonal = std::sqrt(8.0 + discHeight * discHeight);
  const std::vector<glm::dvec3> lights = lightsAround(scene, 16);
  ASSERT_EQ(lights.size(), 16u);
  for (const glm::dvec3& light : lights) {
    EXPECT_NEAR(glm::distance(light, centre), 0.7 * diagonal, 1e-6);
    EXPECT_GT(light.y, discHeight);
  }
}

TEST(ProbeLights, Inside_AreInTheOpenWithinTheBounds) {
  CompiledScene scene = test::ground(4, 1.0f);
  test::append(scene, test::sphere(12, 0.45f, {0.0f, 0.5f, 0.0f}));
  scene.boundsMin = {-1.0f, 0.0f, -1.0f};
  scene.boundsMax = {1.0f, 0.95f, 1.0f};
  Tracer tracer(scene, test::sharedDevice());
  const std::vector<glm::dvec3> lights = lightsInside(scene, tracer, 24);
  ASSERT_EQ(lights.size(), 24u);
  for (const glm::dvec3& light : lights) {
    EXPECT_GT(glm::distance(light, glm::dvec3(0.0, 0.5, 0.0)), 0.45);
    EXPECT_GT(light.y, 0.02);
    EXPECT_LT(std::max(std::abs(light.x), std::abs(light.z)), 1.0);
  }
}

TEST(LineFit, PointsOnALine_AreExplained) {
  const std::vector<Point> points = {{1, 5}, {2, 7}, {5, 13}};
  const LineFit line = fitLine(points);
  EXPECT_NEAR(line.slope, 2.0, 1e-12);
  EXPECT_NEAR(line.intercept, 3.0, 1e-12);
  EXPECT_NEAR(line.r2, 1.0, 1e-12);
}

TEST(LineFit, PointsOfAParabola_AreExplainedInPart) {
  // Around the means (0, 2): xx = 10, xy = 0, so no slope and nothing explained.
  const std::vector<Point> even = {{-2, 4}, {-1, 1}, {0, 0}, {1, 1}, {2, 4}};
  EXPECT_NEAR(fitLine(even).r2, 0.0, 1e-12);
  // 0, 1, 4: slope 2, residuals 1/3, -2/3, 1/3 of deviations -5/3, -2/3, 7/3: 1 - (6/9) / (78/9).
  EXPECT_NEAR(fitLine(std::vector<Point>{{0, 0}, {1, 1}, {2, 4}}).r2, 1.0 - 6.0 / 78.0, 1e-12);
}

}  // namespace
}  // namespace prelight::benchmarks
