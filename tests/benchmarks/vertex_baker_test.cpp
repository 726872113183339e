#include "benchmarks/peers/embree/vertex_baker.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "basis/sh_evaluate.h"
#include "benchmarks/suites/bake/surface_error.h"
#include "support/scenes.h"

namespace prelight::benchmarks {
namespace {

constexpr std::size_t threads = 2;
constexpr std::size_t coefficients = 9;
const double firstOfEvenSky = std::sqrt(4.0 * std::numbers::pi);

/// The inside of a sphere of radius 1, without what is above a height.
CompiledScene insideOfSphere(float below, float albedo) {
  constexpr int segments = 24;
  const CompiledScene whole = test::sphere(segments, 1.0f, glm::vec3(0.0f));
  std::vector<glm::uvec3> kept;
  for (const glm::uvec3& t : whole.triangles) {
    const float middle = (whole.positions[t.x].y + whole.positions[t.y].y + whole.positions[t.z].y) / 3.0f;
    if (middle < below) kept.emplace_back(t.x, t.z, t.y);
  }
  CompiledScene scene = test::sceneOf(whole.positions, kept, albedo);
  for (std::size_t v = 0; v < scene.normals.size(); ++v)
    scene.normals[v] = -glm::normalize(whole.positions[v]);
  return scene;
}

/// Open above half its radius: a quarter of its surface. Whatever place of it sees that quarter of its
/// hemisphere open, weighted by the cosine, as a sphere's surface sees itself evenly.
CompiledScene openSphere(float albedo) { return insideOfSphere(0.5f, albedo); }

/// Accessibility f and, with a bounce of albedo a off what hides the rest, f + a (1 - f) f under an even sky.
constexpr double openShare = 0.25;
constexpr double lightOf(double albedo) { return openShare + albedo * (1.0 - openShare) * openShare; }

/// What an open hemisphere around +Y has.
double openTransfer(std::size_t i) {
  constexpr double shares[] = {1.0, 2.0 / 3.0, 0.25};
  std::vector<double> values(coefficients);
  sh::evaluate({0.0, 1.0, 0.0}, 3, values);
  return shares[i == 0 ? 0 : (i < 4 ? 1 : 2)] * values[i];
}

class VertexBaker : public ::testing::Test {
 protected:
  void SetUp() override {
    if (embreeVersion().empty()) GTEST_SKIP() << "built without Embree";
  }
};

TEST_F(VertexBaker, OnAnOpenPlane_HasTheClosedForm) {
  const CompiledScene scene = test::ground(2, 1.0f);
  const VertexBake ao = bakeAtVertices(scene, {8, false}, threads).value();
  EXPECT_EQ(ao.ao, std::vector<float>(scene.vertexCount(), 1.0f));
  EXPECT_TRUE(ao.transfer.empty());
  const VertexBake bake = bakeAtVertices(scene, {64, true}, threads).value();
  ASSERT_EQ(bake.transfer.size(), scene.vertexCount() * 3 * coefficients);
  for (std::size_t i = 0; i < bake.transfer.size(); ++i)
    EXPECT_NEAR(bake.transfer[i], openTransfer(i % coefficients), 2e-3) << i;
}

TEST_F(VertexBaker, InAClosedSphere_SeesNothing) {
  const CompiledScene scene = insideOfSphere(2.0f, 0.5f);
  const VertexBake bake = bakeAtVertices(scene, {8, true}, threads).value();
  EXPECT_EQ(bake.ao, std::vector<float>(scene.vertexCount(), 0.0f));
  EXPECT_EQ(bake.transfer, std::vector<float>(bake.transfer.size(), 0.0f));
}

TEST_F(VertexBaker, InAnOpenSphere_HasItsOpeningAndOneBounce) {
  const CompiledScene scene = openSphere(0.5f);
  const VertexBake bake = bakeAtVertices(scene, {32, true}, threads).value();
  const VertexBake occlusion = bakeAtVertices(scene, {32, false}, threads).value();
  for (std::uint32_t v = 0; v < scene.vertexCount(); ++v) {
    if (scene.positions[v].y > 0.45f) continue;  // beside the rim or not in use
    EXPECT_NEAR(bake.ao[v], openShare, 0.02) << v;
    EXPECT_NEAR(occlusion.ao[v], openShare, 0.02) << v;
    for (std::size_t c = 0; c < 3; ++c)
      EXPECT_NEAR(firstOfEvenSky * double(bake.transfer[(3 * v + c) * coefficients]), lightOf(0.5), 0.02)
          << v;
  }
}

TEST_F(VertexBaker, InAnOpenSphere_AgreesWithTheTruth) {
  const CompiledScene scene = openSphere(0.5f);
  const auto rays = makeEmbreePeer(scene, PeerQuality::Medium, threads);
  const SurfaceTruth truth = findSurfaceTruth(scene, *rays, 200, 16, Progress());
  const VertexBake bake = bakeAtVertices(scene, {32, true}, threads).value();
  const SurfaceError transfer = surfaceError(scene, truth.places, truth.transfer, bake.transfer);
  EXPECT_LT(transfer.error, 0.03 * transfer.size);
}

class SurfaceTruthTest : public VertexBaker {};

TEST_F(SurfaceTruthTest, InAnOpenSphere_HasItsOpeningAndOneBounce) {
  const CompiledScene scene = openSphere(0.5f);
  const auto rays = makeEmbreePeer(scene, PeerQuality::Medium, threads);
  const SurfaceTruth truth = findSurfaceTruth(scene, *rays, 300, 16, Progress());
  ASSERT_EQ(truth.places.size(), 300u);
  for (const auto* half : {&truth.accessibility.first, &truth.accessibility.second}) {
    double mean = 0.0;
    for (const double open : *half) mean += open / 300.0;
    EXPECT_NEAR(mean, openShare, 3e-3);
  }
  for (const auto* half : {&truth.transfer.first, &truth.transfer.second}) {
    double mean = 0.0;
    for (std::size_t i = 0; i < half->size(); i += coefficients) mean += (*half)[i] / 900.0;
    EXPECT_NEAR(firstOfEvenSky * mean, lightOf(0.5), 3e-3);
  }
}

TEST(SurfaceError, OfValuesThatAreOff_IsHowMuchWithoutTheNoiseOfTheTruth) {
  const CompiledScene scene = test::ground(2, 1.0f);
  const std::vector<SurfaceSample> places = {{0, 0.2f, 0.3f, 1.0f}, {3, 0.1f, 0.7f, 1.0f}};
  // Noise of the two halves is not correlated over the places.
  const TwiceFound truth{{1.5, 0.5}, {0.8, 0.8}};
  const std::vector<float> exact(scene.vertexCount(), 1.0f), off(scene.vertexCount(), 1.3f);
  EXPECT_NEAR(surfaceError(scene, places, truth, exact).error, 0.0, 1e-7);
  EXPECT_NEAR(surfaceError(scene, places, truth, off).error, std::sqrt(0.3 * 0.3 + 0.2 * 0.3), 1e-6);
}

TEST(TimeToError, BetweenPoints_FollowsAPowerLaw) {
  const std::vector<Point> curve = {{1.0, 0.4}, {4.0, 0.2}, {16.0, 0.1}};
  const TimeToError between = timeToError(curve, 0.1 * std::sqrt(2.0));
  EXPECT_EQ(between.kind, TimeToError::Kind::Measured);
  EXPECT_NEAR(between.seconds, 8.0, 1e-9);
}

TEST(TimeToError, OfNoErrorAtAll_IsWhenItIsReached) {
  const std::vector<Point> curve = {{1.0, 0.4}, {4.0, 0.0}};
  EXPECT_NEAR(timeToError(curve, 0.0).seconds, 4.0, 1e-9);
  EXPECT_EQ(timeToError(std::vector<Point>{{1.0, 0.0}}, 0.0).seconds, 1.0);
}

TEST(TimeToError, BeyondTheMeasured_IsABound) {
  const std::vector<Point> curve = {{1.0, 0.4}, {4.0, 0.2}};
  EXPECT_EQ(timeToError(curve, 0.5).kind, TimeToError::Kind::AtMost);
  EXPECT_EQ(timeToError(curve, 0.5).seconds, 1.0);
  EXPECT_EQ(timeToError(curve, 0.1).kind, TimeToError::Kind::AtLeast);
  EXPECT_EQ(timeToError(curve, 0.1).seconds, 4.0);
}

}  // namespace
}  // namespace prelight::benchmarks
