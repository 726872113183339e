#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "support/run_bake.h"
#include "support/scenes.h"

namespace prelight {
namespace {

using std::numbers::pi;

enum Place : std::size_t { position, occlusion, normal, color };

BakeRequest occludersOnly(std::uint64_t rays = 10000) {
  BakeRequest request;
  request.ao = request.occluders.wanted = true;
  request.effort.rays = rays;
  return request;
}

const glm::vec4& vectorOf(const OccluderTransfer& transfer, std::size_t record, Place place) {
  return transfer.vectors[record * transfer.stored.size() + place];
}

/// Form factor of an occluder at a vertex; 0 when it has no record.
double formFactor(const OccluderTransfer& transfer, std::uint32_t vertex, std::uint32_t occluder) {
  for (std::uint32_t r = transfer.offsets[vertex]; r < transfer.offsets[vertex + 1]; ++r)
    if (transfer.occluders[r] == occluder) return vectorOf(transfer, r, occlusion).w;
  return 0.0;
}

/// Expects for every vertex that the form factors of all occluders and the open share sum to 1.
void expectSumsOfOne(const Bake& bake) {
  const OccluderTransfer& transfer = *bake.occluders;
  for (std::uint32_t v = 0; v < bake.ao.size(); ++v) {
    double sum = bake.ao[v];
    for (std::uint32_t r = transfer.offsets[v]; r < transfer.offsets[v + 1]; ++r)
      sum += vectorOf(transfer, r, occlusion).w;
    EXPECT_NEAR(sum, 1.0, 1e-5) << v;
  }
}

/// A ground of 2 m under a ball.
CompiledScene groundAndBall(float radius, float height, int cells = 10, int segments = 16) {
  CompiledScene scene = test::ground(cells, 1.0f);
  test::append(scene, test::sphere(segments, radius, {0, height, 0}));
  scene.materials[1].albedo = {0.25f, 0.5f, 0.75f};
  return scene;
}

// With 10 000 rays per vertex, form factors around 0.1 have 1 % rms noise. The fitted function is
// interpolated, so a coarser mesh would be off by its curvature. A ball above the horizon has (r / d)^2 cos
// (Howell's catalogue).
TEST(OccluderBake, BallAbovePlane_HasItsFormFactor) {
  constexpr float radius = 0.4f, height = 0.9f;
  const CompiledScene scene = groundAndBall(radius, height, 24, 48);
  const OccluderTransfer transfer = *test::runBake(scene, occludersOnly()).bake.occluders;
  ASSERT_EQ(transfer.names.size(), 2u);
  double squares = 0.0;
  for (std::uint32_t v = 0; v < 625; ++v) {
    const glm::dvec3 path = glm::dvec3(0, height, 0) - glm::dvec3(scene.positions[v]);
    const double d2 = glm::dot(path, path);
    const double expected = radius * radius / d2 * height / std::sqrt(d2);
    const double error = formFactor(transfer, v, 1) - expected;
    EXPECT_NEAR(error, 0.0, 0.005) << v;
    squares += error * error / (expected * expected);
  }
  EXPECT_LT(std::sqrt(squares / 625), 0.012);
}

/// Form factor of a rectangle [0, a] x [0, b] at distance 1, parallel to the receiver and with one corner
/// opposite it.
double cornerFactor(double a, double b) {
  const double p = std::sqrt(1.0 + a * a), q = std::sqrt(1.0 + b * b);
  return (a / p * std::atan(b / p) + b / q * std::atan(a / q)) / (2.0 * pi);
}

TEST(OccluderBake, SquareAbovePlane_HasItsFormFactor) {
  CompiledScene scene = test::ground(24, 0.5f);
  CompiledScene lid = test::ground(6, 0.8f, 1.0f);
  for (glm::uvec3& t : lid.triangles) std::swap(t.y, t.z);
  for (glm::vec3& n : lid.normals) n = -n;
  test::append(scene, lid);
  const OccluderTransfer transfer = *test::runBake(scene, occludersOnly()).bake.occluders;
  double squares = 0.0;
  for (std::uint32_t v = 0; v < 625; ++v) {
    const glm::dvec3 p(scene.positions[v]);
    double expected = 0.0;
    for (const double x : {0.8 - p.x, 0.8 + p.x})
      for (const double z : {0.8 - p.z, 0.8 + p.z}) expected += cornerFactor(x, z);
    const double error = formFactor(transfer, v, 1) - expected;
    EXPECT_NEAR(error, 0.0, 0.0145) << v;  // Three deviations of as many random rays.
    squares += error * error / (expected * expected);
  }
  EXPECT_LT(std::sqrt(squares / 625), 0.0055);
}

/// A disk of `segments` triangles that faces down.
CompiledScene disk(int segments, double radius, double height) {
  std::vector<glm::vec3> positions = {glm::vec3(glm::dvec3(0.0, height, 0.0))};
  std::vector<glm::uvec3> triangles;
  for (int k = 0; k < segments; ++k) {
    const double turn = 2.0 * pi * k / segments;
    positions.emplace_back(glm::dvec3(radius * std::cos(turn), height, radius * std::sin(turn)));
    triangles.push_back({0, 1 + k, 1 + (k + 1) % segments});
  }
  return test::sceneOf(positions, triangles);
}

// Howell's catalogue: the form factor of a disk of radius r at distance h, for a parallel element s beside
// its axis, is 1/2 (1 - (s^2 + h^2 - r^2) / sqrt((s^2 + h^2 + r^2)^2 - 4 s^2 r^2)).
TEST(OccluderBake, DiskAbovePlane_HasItsFormFactor) {
  constexpr double radius = 0.6, height = 0.8;
  CompiledScene scene = test::ground(24, 0.7f);
  test::append(scene, disk(128, radius, height));
  const OccluderTransfer transfer = *test::runBake(scene, occludersOnly()).bake.occluders;
  double squares = 0.0;
  for (std::uint32_t v = 0; v < 625; ++v) {
    const glm::dvec3 p(scene.positions[v]);
    const double s2 = p.x * p.x + p.z * p.z, h2 = height * height, r2 = radius * radius, sum = s2 + h2 + r2;
    const double expected = 0.5 * (1.0 - (s2 + h2 - r2) / std::sqrt(sum * sum - 4.0 * s2 * r2));
    const double error = formFactor(transfer, v, 1) - expected;
    EXPECT_NEAR(error, 0.0, 0.01) << v;
    squares += error * error / (expected * expected);
  }
  EXPECT_LT(std::sqrt(squares / 625), 0.0085);
}

TEST(OccluderBake, FormFactors_AddUpToOneWithAo) {
  expectSumsOfOne(test::runBake(groundAndBall(0.4f, 0.3f), occludersOnly(256)).bake);
}

TEST(OccluderBake, Vectors_PointToWhatIsSeen) {
  const CompiledScene scene = groundAndBall(0.3f, 0.8f);
  const OccluderTransfer transfer = *test::runBake(scene, occludersOnly(4096)).bake.occluders;
  std::uint32_t seen = 0;
  for (std::uint32_t v = 0; v < 121; ++v)
    for (std::uint32_t r = transfer.offsets[v]; r < transfer.offsets[v + 1]; ++r) {
      if (transfer.occluders[r] != 1) continue;
      ++seen;
      const glm::dvec3 vertex(scene.positions[v]), path = glm::dvec3(0, 0.8, 0) - vertex;
      const glm::vec4 direction = vectorOf(transfer, r, occlusion);
      EXPECT_GT(glm::dot(glm::normalize(glm::dvec3(direction)), glm::normalize(path)), 0.99) << v;
      EXPECT_LE(glm::length(glm::dvec3(direction)), double(direction.w) * 1.000001);
      const glm::vec4 place = vectorOf(transfer, r, position);
      EXPECT_NEAR(glm::length(glm::dvec3(place) - glm::dvec3(0, 0.8, 0)), 0.2, 0.12) << v;
      EXPECT_NEAR(place.w, glm::length(path) - 0.21, 0.06) << v;
      // The visible side faces the receiver.
      const glm::vec4 facing = vectorOf(transfer, r, normal);
      EXPECT_LT(glm::dot(glm::normalize(glm::dvec3(facing)), glm::normalize(path)), -0.9) << v;
      EXPECT_LE(facing.w, direction.w * 1.000001f);
      const glm::vec4 albedo = vectorOf(transfer, r, color);
      EXPECT_NEAR(albedo.r, 0.25f, 0.002f);
      EXPECT_NEAR(albedo.b, 0.75f, 0.002f);
    }
  EXPECT_GT(seen, 100u);
}

TEST(OccluderBake, BlackOccluders_HideAllTheSame) {
  CompiledScene scene = groundAndBall(0.4f, 0.9f);
  const double gray = formFactor(*test::runBake(scene, occludersOnly(1024)).bake.occluders, 60, 1);
  scene.materials[0].albedo = scene.materials[1].albedo = glm::vec3(0.0f);
  BakeRequest request = occludersOnly(1024);
  request.sh.order = 2;
  request.bounces = 2;
  EXPECT_NEAR(formFactor(*test::runBake(scene, request).bake.occluders, 60, 1), gray, 0.002);
  EXPECT_GT(gray, 0.1);
}

// Further requests do not change the records.
TEST(OccluderBake, WithBounces_IsTheSame) {
  const CompiledScene scene = groundAndBall(0.4f, 0.9f);
  BakeRequest request = occludersOnly(256);
  const OccluderTransfer alone = *test::runBake(scene, request).bake.occluders;
  request.sh.order = 3;
  request.bounces = 2;
  const OccluderTransfer both = *test::runBake(scene, request).bake.occluders;
  for (std::uint32_t v = 0; v < scene.vertexCount(); ++v)
    for (const std::uint32_t occluder : {0u, 1u})
      EXPECT_NEAR(formFactor(alone, v, occluder), formFactor(both, v, occluder), 1e-5);
}

TEST(OccluderBake, LeastFormFactor_DropsRecordsAndSaysWhat) {
  const CompiledScene scene = groundAndBall(0.4f, 0.9f);
  BakeRequest request = occludersOnly(256);
  const std::size_t all = test::runBake(scene, request).bake.occluders->recordCount();
  request.occluders.leastFormFactor = 0.05;
  const test::BakeResult dropped = test::runBake(scene, request);
  EXPECT_LT(dropped.bake.occluders->recordCount(), all);
  for (std::size_t r = 0; r < dropped.bake.occluders->recordCount(); ++r)
    EXPECT_GE(vectorOf(*dropped.bake.occluders, r, occlusion).w, 0.05f);
  const auto& notes = dropped.report.notes;
  EXPECT_TRUE(std::any_of(notes.begin(), notes.end(), [](const std::string& note) {
    return note.find("the dropped ones hide") != std::string::npos;
  }));
}

TEST(OccluderBake, Kinds_GroupByNodeMeshOrMaterial) {
  CompiledScene scene = groundAndBall(0.3f, 0.6f);
  test::append(scene, test::sphere(8, 0.1f, {0.6f, 0.4f, 0}));
  scene.primitives[1].mesh = scene.primitives[2].mesh = 5;
  const auto occluders = [&](OccluderKind kind) {
    BakeRequest request = occludersOnly(64);
    request.occluders.kind = kind;
    return test::runBake(scene, request).bake.occluders->names.size();
  };
  EXPECT_EQ(occluders(OccluderKind::Node), 3u);
  EXPECT_EQ(occluders(OccluderKind::Mesh), 2u);
  for (std::uint32_t t = scene.primitives[2].firstTriangle; t < scene.triangleCount(); ++t)
    scene.triangleMaterials[t] = 0;
  EXPECT_EQ(occluders(OccluderKind::Material), 2u);
}

TEST(OccluderBake, Auto_KeepsToTheRecordsAndToTheSum) {
  const CompiledScene scene = groundAndBall(0.4f, 0.5f);
  BakeRequest request = occludersOnly(256);
  request.occluders.kind = OccluderKind::Auto;
  for (const double records : {2.0, 4.0, 6.0}) {  // Two nodes need at least 1.2.
    request.occluders.records = records;
    const Bake bake = test::runBake(scene, request).bake;
    const OccluderTransfer& transfer = *bake.occluders;
    EXPECT_LE(double(transfer.recordCount()), records * scene.vertexCount() + 1e-9);
    EXPECT_GT(double(transfer.recordCount()), 0.7 * records * scene.vertexCount());
    expectSumsOfOne(bake);
  }
}

TEST(OccluderBake, OpenPlane_HasNoRecords) {
  const OccluderTransfer transfer = *test::runBake(test::ground(4, 1.0f), occludersOnly(64)).bake.occluders;
  EXPECT_EQ(transfer.recordCount(), 0u);
  EXPECT_EQ(transfer.offsets, std::vector<std::uint32_t>(26, 0));
}

TEST(OccluderBake, SameSeed_SameBytes) {
  const CompiledScene scene = groundAndBall(0.4f, 0.9f);
  const Bake first = test::runBake(scene, occludersOnly(128)).bake,
             again = test::runBake(scene, occludersOnly(128)).bake;
  EXPECT_EQ(first.occluders->occluders, again.occluders->occluders);
  EXPECT_EQ(first.occluders->vectors, again.occluders->vectors);
}

}  // namespace
}  // namespace prelight
