// SH transfer that follows skins and morphs from one pose to another.
#include "techniques/sh/bent_transfer.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <random>

#include "basis/sh_rotation.h"
#include "basis/sh_zonal.h"
#include "compress/compression_error.h"
#include "scene/deform.h"
#include "support/run_bake.h"
#include "support/scenes.h"
#include "techniques/registry/keyed_bake.h"
#include "techniques/sh/vertex_turns.h"

namespace prelight::test {
namespace {

constexpr int order = 4;
constexpr std::size_t width = order * order;

/// Moves the vertices from `first` on by a rotation about a point.
void turnVertices(CompiledScene& scene, std::size_t first, const glm::dmat3& rotation,
                  const glm::dvec3& about) {
  for (std::size_t v = first; v < scene.vertexCount(); ++v) {
    scene.positions[v] = glm::vec3(about + rotation * (glm::dvec3(scene.positions[v]) - about));
    scene.normals[v] = glm::vec3(rotation * glm::dvec3(scene.normals[v]));
  }
}

glm::dmat3 rotationBy(double angle, const glm::dvec3& axis) {
  return glm::dmat3(glm::rotate(glm::dmat4(1.0), angle, glm::normalize(axis)));
}

double difference(const glm::dmat3& a, const glm::dmat3& b) {
  double greatest = 0.0;
  for (int c = 0; c < 3; ++c)
    for (int r = 0; r < 3; ++r) greatest = std::max(greatest, std::abs(a[c][r] - b[c][r]));
  return greatest;
}

TEST(VertexTurns, RigidRotations_AreFoundAtEveryVertexOfEveryMesh) {
  for (const CompiledScene& rest :
       {sphere(6, 1.0f, {1, 2, 3}), ground(3, 2.0f), box(1, {0, 0, 0}, {1, 2, 3}, false)})
    for (const double angle : {0.0, 0.3, 2.0, 3.1}) {
      const glm::dmat3 rotation = rotationBy(angle, {0.3, -0.5, 0.8});
      CompiledScene turned = rest;
      turnVertices(turned, 0, rotation, {0.5, 0.1, -0.2});
      for (const glm::dmat3& turn : vertexTurns(rest, turned)) EXPECT_LT(difference(turn, rotation), 1e-5);
    }
}

TEST(VertexTurns, StretchedSurface_DoesNotTurn) {
  const CompiledScene rest = ground(4, 1.0f);
  CompiledScene stretched = rest;
  for (glm::vec3& p : stretched.positions) p.x *= 1.5f;
  for (const glm::dmat3& turn : vertexTurns(rest, stretched))
    EXPECT_LT(difference(turn, glm::dmat3(1.0)), 1e-6);
}

TEST(VertexTurns, VertexWithoutTriangles_TurnsWithItsNormal) {
  CompiledScene rest = ground(1, 1.0f), bent = rest;
  rest.triangles.clear();
  bent.normals.assign(bent.vertexCount(), glm::vec3(1, 0, 0));
  for (const glm::dmat3& turn : vertexTurns(rest, bent))
    EXPECT_LT(glm::length(turn * glm::dvec3(0, 1, 0) - glm::dvec3(1, 0, 0)), 1e-6);
  bent.normals.assign(bent.vertexCount(), glm::vec3(0, -1, 0));
  for (const glm::dmat3& turn : vertexTurns(rest, bent)) {
    EXPECT_LT(glm::length(turn * glm::dvec3(0, 1, 0) - glm::dvec3(0, -1, 0)), 1e-6);
    EXPECT_NEAR(glm::determinant(turn), 1.0, 1e-9);
  }
}

/// Transfer of open surfaces, plus `occluded` times random numbers.
HarmonicTransfer transferOf(const CompiledScene& scene, int channels, double occluded) {
  HarmonicTransfer transfer{order, channels, channels > 1 ? 1 : 0, {}};
  std::mt19937 random(5);
  std::uniform_real_distribution<double> number(-occluded, occluded);
  std::vector<double> open(width);
  for (const glm::vec3& normal : scene.normals) {
    sh::openTransfer(glm::dvec3(normal), order, open);
    for (int channel = 0; channel < channels; ++channel)
      for (const double value : open)
        transfer.coefficients.push_back(static_cast<float>(value + (occluded > 0.0 ? number(random) : 0.0)));
  }
  return transfer;
}

TEST(BentTransfer, OpenSurface_FollowsItsNormalExactly) {
  const CompiledScene rest = sphere(5, 1.0f, {0, 0, 0});
  CompiledScene bent = rest;
  turnVertices(bent, 0, rotationBy(1.2, {1, 2, 3}), {0, 0, 0});
  const HarmonicTransfer got = bentTransfer(transferOf(rest, 3, 0.0), bendBetween(rest, bent));
  const HarmonicTransfer expected = transferOf(bent, 3, 0.0);
  for (std::size_t i = 0; i < expected.coefficients.size(); ++i)
    ASSERT_NEAR(got.coefficients[i], expected.coefficients[i], 1e-5) << i;
}

TEST(BentTransfer, OcclusionOfATurnedVertex_IsTheMeanOfTheTurnedAndTheStandingOne) {
  const CompiledScene rest = sphere(3, 1.0f, {0, 0, 0});
  const glm::dmat3 rotation = rotationBy(-0.7, {2, 1, -1});
  CompiledScene bent = rest;
  turnVertices(bent, 0, rotation, {0, 1, 0});
  const HarmonicTransfer transfer = transferOf(rest, 1, 0.2), open = transferOf(rest, 1, 0.0);
  const HarmonicTransfer openThen = transferOf(bent, 1, 0.0);
  const HarmonicTransfer got = bentTransfer(transfer, bendBetween(rest, bent));
  for (std::size_t v = 0; v < rest.vertexCount(); ++v) {
    std::vector<double> change(width);
    for (std::size_t i = 0; i < width; ++i)
      change[i] = double(transfer.coefficients[v * width + i]) - double(open.coefficients[v * width + i]);
    const std::vector<double> turned = sh::rotate(change, order, rotation);
    for (std::size_t i = 0; i < width; ++i)
      ASSERT_NEAR(got.coefficients[v * width + i],
                  double(openThen.coefficients[v * width + i]) + 0.5 * (change[i] + turned[i]), 1e-5);
  }
}

TEST(BentTransfer, VerticesThatStay_KeepTheirBits) {
  CompiledScene rest = ground(2, 1.0f);
  const std::size_t first = rest.vertexCount();
  append(rest, sphere(3, 0.5f, {0, 1, 0}));
  CompiledScene bent = rest;
  turnVertices(bent, first, rotationBy(0.5, {1, 0, 0}), {0, 1, 0});
  const HarmonicTransfer transfer = transferOf(rest, 1, 0.3);
  const HarmonicTransfer got = bentTransfer(transfer, bendBetween(rest, bent));
  const auto stays = static_cast<std::ptrdiff_t>(first * width);
  EXPECT_TRUE(std::equal(transfer.coefficients.begin(), transfer.coefficients.begin() + stays,
                         got.coefficients.begin()));
  EXPECT_FALSE(std::equal(transfer.coefficients.begin() + stays, transfer.coefficients.end(),
                          got.coefficients.begin() + stays));
}

/// Root mean square of the error of the vertices from `first` on, relative to the transfer.
double errorOf(const HarmonicTransfer& truth, const HarmonicTransfer& other, std::size_t first) {
  double error = 0.0, all = 0.0;
  for (std::size_t i = first * width; i < truth.coefficients.size(); ++i) {
    error += std::pow(double(truth.coefficients[i]) - double(other.coefficients[i]), 2.0);
    all += std::pow(double(truth.coefficients[i]), 2.0);
  }
  return std::sqrt(error / all);
}

/// A closed box of which one end bends sideways, above a ground.
CompiledScene barOverGround(double angle) {
  CompiledScene scene = ground(1, 4.0f);
  const std::size_t first = scene.vertexCount();
  append(scene, box(8, {-0.3f, 0.2f, -0.3f}, {0.3f, 2.2f, 0.3f}, false));
  for (std::size_t v = first; v < scene.vertexCount(); ++v) {
    const double share = (double(scene.positions[v].y) - 0.2) / 2.0;
    const glm::dvec3 about(0.0, 0.2, 0.0);
    const glm::dmat3 rotation = rotationBy(angle * share, {0, 0, 1});
    scene.positions[v] = glm::vec3(about + rotation * (glm::dvec3(scene.positions[v]) - about));
    scene.normals[v] = glm::vec3(rotation * glm::dvec3(scene.normals[v]));
  }
  return scene;
}

TEST(BentBake, BendingBar_IsNearerToItsBakeThanTransferThatStays) {
  BakeRequest request;
  request.sh.order = order;
  request.effort.rays = 256;
  const CompiledScene rest = barOverGround(0.0), bent = barOverGround(0.9);
  const Bake baked = runBake(rest, request).bake, there = runBake(bent, request).bake;
  const Bake followed = BentBake(baked, rest).at(bent);
  const std::size_t first = ground(1, 4.0f).vertexCount();
  const double stayed = errorOf(*there.sh, *baked.sh, first);
  EXPECT_GT(stayed, 0.2) << "the bend is small";
  EXPECT_LT(errorOf(*there.sh, *followed.sh, first), 0.6 * stayed);
}

TEST(BentBake, CompressedTransferAndNearLamps_AreBentToo) {
  BakeRequest request;
  request.sh.order = order;
  request.effort.rays = 16;
  const CompiledScene rest = barOverGround(0.0), bent = barOverGround(0.9);
  Bake bake = runBake(rest, request).bake;
  const HarmonicTransfer expected = *BentBake(bake, rest).at(bent).sh;
  bake.nearLamps =
      NearLampTransfer{2, 2, 0.1, 1.0, std::vector<std::uint16_t>(rest.vertexCount() * 8, 0x3c00)};
  const Bake followed = BentBake(bake, rest).at(bent);
  ASSERT_TRUE(followed.nearLamps);
  EXPECT_EQ(followed.nearLamps->halves[8 * (rest.vertexCount() - 1)], 0x3c00) << "band 0 does not turn";
  EXPECT_NE(followed.nearLamps->halves, bake.nearLamps->halves);
  bake.compressedSh = compress(*bake.sh, {CompressionMethod::Half}, surfaceOfVertices(rest));
  bake.sh.reset();
  EXPECT_TRUE(BentBake::servesFor(bake));
  EXPECT_LT(errorOf(expected, *BentBake(bake, rest).at(bent).sh, 0), 2e-3);
  EXPECT_FALSE(BentBake::servesFor({}));
}

}  // namespace
}  // namespace prelight::test
