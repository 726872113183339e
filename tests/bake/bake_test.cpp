#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "bake/baker.h"
#include "bake/make_plan.h"
#include "support/devices.h"
#include "support/scenes.h"

namespace prelight {
namespace {

struct Result {
  Bake bake;
  BakeReport report;
};

Result run(const CompiledScene& scene, const BakeRequest& request) {
  Result result;
  Progress progress;
  result.bake = bakeScene(scene, request, makePlan(Scene(), scene, request), test::sharedDevice(), progress,
                          result.report);
  return result;
}

BakeRequest aoRequest(std::uint64_t rays) {
  BakeRequest request;
  request.ao = true;
  request.effort.rays = rays;
  return request;
}

BakeRequest shRequest(int order, int bounces, std::uint64_t rays) {
  BakeRequest request = aoRequest(rays);
  request.sh.order = order;
  request.bounces = bounces;
  return request;
}

/// Light that a vertex receives from a white sky of radiance 1, relative to an unoccluded vertex: sqrt(4 pi)
/// T_00.
double underWhiteSky(const Bake& bake, std::size_t vertex, std::size_t channel) {
  const auto n = static_cast<std::size_t>(bake.sh->order * bake.sh->order);
  return std::sqrt(4.0 * std::numbers::pi) *
         bake.sh->coefficients[(vertex * static_cast<std::size_t>(bake.sh->channels) + channel) * n];
}

TEST(Bake, OpenPlane_IsExact) {
  const CompiledScene scene = test::ground(6, 1.0f);
  const Bake bake = run(scene, shRequest(3, 0, 64)).bake;
  std::vector<double> expected(9);
  // Clamped cosine along +Y (real SH, polar axis z): A_l / pi Y_lm(0,1,0) in bands 0, 1 and 2.
  expected[0] = 0.28209479177387814;
  expected[1] = 2.0 / 3.0 * 0.48860251190291992;
  expected[6] = 0.25 * -0.31539156525252005;
  expected[8] = 0.25 * -0.54627421529603959;
  for (std::size_t v = 0; v < scene.vertexCount(); ++v) {
    EXPECT_EQ(bake.ao[v], 1.0f);
    EXPECT_NEAR(glm::distance(bake.bentNormals[v], glm::vec3(0, 1, 0)), 0.0, 1e-6);
    for (std::size_t i = 0; i < 9; ++i)
      EXPECT_NEAR(bake.sh->coefficients[9 * v + i], expected[i], 1e-6) << "coefficient " << i;
  }
}

// A very wide and high wall beside the floor hides the same half of the sky from every point of it. The
// cosine-weighted mean direction of the open half is 2/3 up + 4/(3 pi) away from the wall.
TEST(Bake, FloorBesideAnEndlessWall_BendsAwayFromIt) {
  const double turn = 0.6, far = 2000.0;
  const glm::dvec3 away(std::cos(turn), 0.0, std::sin(turn)), along(-std::sin(turn), 0.0, std::cos(turn)),
      up(0, 1, 0);
  const glm::dvec3 foot = -2.0 * away - up;
  CompiledScene scene = test::ground(4, 1.0f);
  const std::size_t floorVertices = scene.vertexCount();
  test::append(scene, test::sceneOf({glm::vec3(foot - far * along), glm::vec3(foot + far * along),
                                     glm::vec3(foot + far * along + far * up),
                                     glm::vec3(foot - far * along + far * up)},
                                    {{0, 2, 1}, {0, 3, 2}}));
  ASSERT_GT(glm::dot(geometricNormal(scene, scene.triangleCount() - 1), away), 0.0);
  const Bake bake = run(scene, aoRequest(4096)).bake;
  const glm::dvec3 expected = glm::normalize(2.0 / 3.0 * up + 4.0 / (3.0 * std::numbers::pi) * away);
  for (std::size_t v = 0; v < floorVertices; ++v) {
    EXPECT_NEAR(bake.ao[v], 0.5, 0.02) << v;
    EXPECT_NEAR(glm::distance(glm::dvec3(bake.bentNormals[v]), expected), 0.0, 0.02) << v;
  }
}

// The pilot casts two of eight passes in full; the other six cast one ray in four.
TEST(Bake, OpenPlane_IsThinnedAfterThePilot) {
  const Result result = run(test::ground(10, 1.0f), aoRequest(2048));
  EXPECT_NEAR(result.report.skippedRayFraction, 6.0 / 8.0 * 3.0 / 4.0, 0.06);
}

TEST(Bake, ClosedBoxInside_IsThinnedUnlessItBounces) {
  CompiledScene scene = test::box(6, {-1, -1, -1}, {1, 1, 1}, true);
  EXPECT_GT(run(scene, aoRequest(2048)).report.skippedRayFraction, 0.5);
  for (auto& material : scene.materials) material.albedo = glm::vec3(0.5f);
  EXPECT_LT(run(scene, shRequest(2, 1, 1024)).report.skippedRayFraction, 0.01);
}

/// Surface means of the unclamped SH coefficients: T_0 is AO / (2 sqrt(pi)).
std::vector<double> meanTransfer(const CompiledScene& scene, const Bake& bake) {
  const std::size_t n = bake.sh->coefficients.size() / scene.vertexCount();
  std::vector<double> sums(n, 0.0);
  double area = 0.0;
  for (std::uint32_t t = 0; t < scene.triangleCount(); ++t) {
    const double a = glm::length(geometricNormal(scene, t));
    area += a;
    for (int k = 0; k < 3; ++k)
      for (std::size_t i = 0; i < n; ++i)
        sums[i] += a / 3.0 * bake.sh->coefficients[scene.triangles[t][k] * n + i];
  }
  for (double& s : sums) s /= area;
  return sums;
}

// A small occluder is easily missed by a pilot. The mean over seeds would be too bright if rays stopped where
// the pilot met nothing, or if the pilot's rays were averaged with a number of rays that depends on them.
class AdaptiveCast : public ::testing::TestWithParam<bool> {};

TEST_P(AdaptiveCast, MeanOverSeeds_IsTheLongBakesWithinItsStandardError) {
  const bool byError = GetParam();
  CompiledScene scene = test::ground(8, 3.0f);
  test::append(scene, test::sphere(4, 0.08f, {0.3f, 0.6f, 0.2f}));
  double skipped = 0.0;
  /// Mean and squared standard error of the four coefficients.
  const auto statistics = [&](BakeRequest request, std::uint64_t firstSeed, int seeds) {
    std::vector<double> mean(4, 0.0), square(4, 0.0);
    for (int seed = 0; seed < seeds; ++seed) {
      request.seed = firstSeed + static_cast<std::uint64_t>(seed);
      const Result result = run(scene, request);
      skipped = result.report.skippedRayFraction;
      const std::vector<double> values = meanTransfer(scene, result.bake);
      for (std::size_t i = 0; i < 4; ++i) {
        mean[i] += values[i] / seeds;
        square[i] += values[i] * values[i] / seeds;
      }
    }
    for (std::size_t i = 0; i < 4; ++i) square[i] = (square[i] - mean[i] * mean[i]) / (seeds - 1);
    return std::pair(mean, square);
  };
  const auto [truth, truthVariance] = statistics(shRequest(2, 0, 16384), 9999, 8);
  BakeRequest request = shRequest(2, 0, 1024);
  if (byError) request.effort.error = 0.02;
  const auto [mean, variance] = statistics(request, 0, 250);
  if (!byError) {
    EXPECT_GT(skipped, 0.1) << "the test is about bakes that adapt";
  }
  for (std::size_t i = 0; i < 4; ++i) {
    const double standardError = std::sqrt(variance[i] + truthVariance[i]);
    EXPECT_NEAR(mean[i], truth[i], 3.5 * standardError) << "coefficient " << i;
    EXPECT_LT(standardError, 5e-5);
  }
}

INSTANTIATE_TEST_SUITE_P(RaysAndError, AdaptiveCast, ::testing::Bool());

TEST(Bake, ClosedBoxInside_IsBlack) {
  const CompiledScene scene = test::box(6, {-1, -1, -1}, {1, 1, 1}, true);
  const Bake bake = run(scene, shRequest(3, 2, 256)).bake;
  for (std::size_t v = 0; v < scene.vertexCount(); ++v) {
    EXPECT_NEAR(bake.ao[v], 0.0f, 2e-5f);  // The fit's solver stops at 1e-6 of the right-hand side.
    EXPECT_NEAR(glm::length(bake.bentNormals[v]), 1.0f, 1e-5f);
  }
  // The baseline is subtracted and added back within the solver's tolerance.
  for (const float c : bake.sh->coefficients) EXPECT_NEAR(c, 0.0f, 2e-5f);
}

// A sphere of radius R whose centre is d away at an angle a from the normal hides cos(a) (R / d)^2 of the
// cosine-weighted hemisphere if all of it is above the horizon.
TEST(Bake, SphereOverPlane_HidesItsFormFactor) {
  const float radius = 0.8f, height = 1.5f;
  CompiledScene scene = test::ground(40, 4.0f);
  const std::uint32_t groundVertices = scene.vertexCount();
  test::append(scene, test::sphere(48, radius, {0, height, 0}));
  const Bake bake = run(scene, aoRequest(4096)).bake;
  double sum = 0.0;
  for (std::uint32_t v = 0; v < groundVertices; ++v) {
    const glm::vec3 p = scene.positions[v];
    const double d2 = double(p.x) * p.x + double(p.z) * p.z + height * height;
    const double error = bake.ao[v] - (1.0 - height / std::sqrt(d2) * radius * radius / d2);
    EXPECT_NEAR(error, 0.0, 0.02) << "at " << p.x << ' ' << p.z;
    sum += error * error;
  }
  EXPECT_LT(std::sqrt(sum / groundVertices), 0.003);
}

// An endless wall of height H at distance x hides (1 - x / sqrt(x^2 + H^2)) / 2.
TEST(Bake, WallCorner_HidesTheWallsFormFactor) {
  CompiledScene scene = test::ground(40, 2.0f);
  const std::uint32_t groundVertices = scene.vertexCount();
  const float height = 1.0f;
  test::append(scene, test::sceneOf({{-2, 0, -200}, {-2, 0, 200}, {-2, height, 200}, {-2, height, -200}},
                                    {{0, 1, 2}, {0, 2, 3}}));
  const Bake bake = run(scene, aoRequest(2048)).bake;
  double sum = 0.0;
  for (std::uint32_t v = 0; v < groundVertices; ++v) {
    const double x = scene.positions[v].x + 2.0;
    const double error = bake.ao[v] - (1.0 - 0.5 * (1.0 - x / std::sqrt(x * x + height * height)));
    EXPECT_NEAR(error, 0.0, 0.03) << "at distance " << x;
    sum += error * error;
  }
  EXPECT_LT(std::sqrt(sum / groundVertices), 0.006);
}

/// Lower part of a sphere seen from inside. From every point on a sphere, each part of it is seen in
/// proportion to its area.
CompiledScene bowl(float albedo, double& presentShare) {
  CompiledScene whole = test::sphere(48, 1.0f, {});
  std::vector<glm::uvec3> kept;
  double keptArea = 0.0, area = 0.0;
  for (std::uint32_t t = 0; t < whole.triangleCount(); ++t) {
    const auto& c = whole.triangles[t];
    const double a = glm::length(geometricNormal(whole, t));
    area += a;
    if (whole.positions[c.x].y + whole.positions[c.y].y + whole.positions[c.z].y > 1.0f) continue;
    keptArea += a;
    kept.push_back({c.x, c.z, c.y});
  }
  presentShare = keptArea / area;
  CompiledScene scene = test::sceneOf(whole.positions, kept, albedo);
  return scene;
}

TEST(Bake, BowlUnderWhiteSky_IsAFurnaceOfClosedForm) {
  double share = 0.0;
  const float albedo = 0.8f;
  const CompiledScene scene = bowl(albedo, share);
  const int bounces = 3;
  const Bake bake = run(scene, shRequest(2, bounces, 1024)).bake;
  // Direct light is 1 - s, and every bounce returns albedo x s of the one before.
  double expected = 0.0;
  for (int b = 0; b <= bounces; ++b) expected += (1.0 - share) * std::pow(albedo * share, b);
  std::vector<char> used(scene.vertexCount(), 0);
  for (const auto& t : scene.triangles)
    for (int k = 0; k < 3; ++k) used[t[k]] = 1;
  double direct = 0.0, total = 0.0, count = 0.0;
  for (std::uint32_t v = 0; v < scene.vertexCount(); ++v) {
    if (!used[v]) continue;
    EXPECT_NEAR(bake.ao[v], 1.0 - share, 0.03);
    EXPECT_NEAR(underWhiteSky(bake, v, 0), expected, 0.05);
    direct += bake.ao[v];
    total += underWhiteSky(bake, v, 1);
    count += 1.0;
  }
  EXPECT_NEAR(direct / count, 1.0 - share, 0.003);
  EXPECT_NEAR(total / count, expected, 0.005);
}

// A roof over the ground reflects light from below whichever way its front faces.
TEST(Bake, RoofSeenFromBehind_ReflectsLikeItsFront) {
  const auto roofOver = [](bool facesDown) {
    CompiledScene scene = test::ground(8, 1.0f);
    CompiledScene roof = test::ground(8, 1.0f, 0.6f);
    if (facesDown)
      for (auto& t : roof.triangles) std::swap(t.y, t.z);
    test::append(scene, roof);
    for (auto& material : scene.materials) material.albedo = glm::vec3(0.9f);
    return scene;
  };
  const CompiledScene front = roofOver(true), back = roofOver(false);
  const Bake a = run(front, shRequest(2, 2, 2048)).bake, b = run(back, shRequest(2, 2, 2048)).bake;
  double difference = 0.0, bounced = 0.0;
  for (std::size_t v = 0; v < 81; ++v) {
    difference += std::abs(underWhiteSky(a, v, 0) - underWhiteSky(b, v, 0));
    bounced += underWhiteSky(a, v, 0) - a.ao[v];
  }
  EXPECT_GT(bounced / 81, 0.05);
  EXPECT_LT(difference / 81, 0.01);
}

TEST(Bake, ColouredSender_TintsItsNeighbour) {
  CompiledScene scene = test::ground(8, 1.0f);
  test::append(scene,
               test::sceneOf({{-1, 0, -1}, {-1, 0, 1}, {-1, 1, 1}, {-1, 1, -1}}, {{0, 1, 2}, {0, 2, 3}}));
  scene.materials[1].albedo = {1.0f, 0.0f, 0.0f};
  scene.materials[0].albedo = glm::vec3(0.0f);
  const Bake bake = run(scene, shRequest(2, 1, 1024)).bake;
  const std::size_t beside = 4;  // The vertex at x = -1, z = 0.
  EXPECT_GT(underWhiteSky(bake, beside, 0), bake.ao[beside] + 0.1);
  EXPECT_NEAR(underWhiteSky(bake, beside, 1), underWhiteSky(bake, beside, 2), 1e-6);
  EXPECT_LT(underWhiteSky(bake, beside, 1), underWhiteSky(bake, beside, 0) - 0.1);
}

TEST(Bake, BlackScene_SkipsBounces) {
  CompiledScene scene = test::box(4, {-1, -1, -1}, {1, 1, 1}, false);
  for (auto& material : scene.materials) material.albedo = glm::vec3(0.0f);
  const Bake bake = run(scene, shRequest(3, 4, 64)).bake;
  EXPECT_EQ(bake.sh->channels, 1);
  EXPECT_EQ(bake.sh->bounces, 0);
}

CompiledScene clutter() {
  CompiledScene scene = test::ground(20, 2.0f);
  test::append(scene, test::box(5, {-1, 0.01f, -1}, {-0.2f, 1, 0.4f}, false));
  test::append(scene, test::sphere(12, 0.5f, {0.8f, 0.6f, 0.5f}));
  for (auto& material : scene.materials) material.albedo = glm::vec3(0.6f);
  return scene;
}

TEST(Bake, SameSeed_SameBytes_OtherSeed_OtherBytesWithinTheError) {
  const CompiledScene scene = clutter();
  BakeRequest request = shRequest(3, 1, 256);
  const Result a = run(scene, request), b = run(scene, request);
  request.seed = 1;
  const Result c = run(scene, request);
  EXPECT_EQ(a.bake.ao, b.bake.ao);
  EXPECT_EQ(a.bake.sh->coefficients, b.bake.sh->coefficients);
  EXPECT_NE(a.bake.ao, c.bake.ao);
  double sum = 0.0;
  for (std::size_t v = 0; v < a.bake.ao.size(); ++v) sum += std::pow(a.bake.ao[v] - c.bake.ao[v], 2);
  EXPECT_LT(std::sqrt(sum / double(a.bake.ao.size())), 5.0 * a.report.aoErrorRms);
}

double rmsDifference(const std::vector<float>& a, const std::vector<float>& b) {
  double sum = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += (a[i] - b[i]) * (a[i] - b[i]);
  return std::sqrt(sum / double(a.size()));
}

/// RMS difference of two bakes' interpolated AO over the surface.
double surfaceDifference(const CompiledScene& scene, const Bake& x, const Bake& y) {
  double sum = 0.0, area = 0.0;
  for (std::uint32_t t = 0; t < scene.triangleCount(); ++t) {
    double d[3];
    for (int k = 0; k < 3; ++k) d[k] = x.ao[scene.triangles[t][k]] - y.ao[scene.triangles[t][k]];
    const double a = glm::length(geometricNormal(scene, t));
    sum += a * (d[0] * d[0] + d[1] * d[1] + d[2] * d[2] + d[0] * d[1] + d[1] * d[2] + d[2] * d[0]) / 6.0;
    area += a;
  }
  return std::sqrt(sum / area);
}

class ReportedError : public ::testing::TestWithParam<std::uint64_t> {};

TEST_P(ReportedError, AtAnyNumberOfRays_IsWithinHalfOfTheScatterOverSeeds) {
  const CompiledScene scene = clutter();
  BakeRequest request = aoRequest(GetParam());
  double scatter = 0.0, reported = 0.0;
  for (std::uint64_t seed = 0; seed < 4; ++seed) {
    request.seed = 2 * seed;
    const Result a = run(scene, request);
    request.seed = 2 * seed + 1;
    const Result b = run(scene, request);
    const double difference = surfaceDifference(scene, a.bake, b.bake);
    scatter += difference * difference / 2.0;  // Each of the two has half of the variance.
    reported += 0.5 * (a.report.aoErrorRms * a.report.aoErrorRms + b.report.aoErrorRms * b.report.aoErrorRms);
  }
  EXPECT_LT(std::sqrt(scatter / reported), 1.5);
  EXPECT_GT(std::sqrt(scatter / reported), 1.0 / 1.5);
}

INSTANTIATE_TEST_SUITE_P(Rays, ReportedError, ::testing::Values(16u, 32u, 64u, 128u, 256u, 1024u));

TEST(Bake, ErrorTarget_IsMetAndCostsLessInTheOpen) {
  const CompiledScene cluttered = clutter();
  BakeRequest request = aoRequest(1);
  request.effort.error = 0.01;
  const Result result = run(cluttered, request);
  const Bake truth = run(cluttered, aoRequest(16384)).bake;
  EXPECT_LT(rmsDifference(result.bake.ao, truth.ao), 0.015);
  const CompiledScene open = test::ground(24, 2.0f);
  const Result openResult = run(open, request);
  EXPECT_LT(double(openResult.report.rays) / open.vertexCount(),
            0.5 * double(result.report.rays) / cluttered.vertexCount());
}

TEST(Bake, TimeTarget_StopsInTime) {
  BakeRequest request = aoRequest(1);
  request.effort.seconds = 0.5;
  const Result result = run(clutter(), request);
  EXPECT_GT(result.report.rays, 1000u);
  EXPECT_LT(result.bake.info.seconds, 10.0) << "a loose bound: machines differ";
}

TEST(Bake, LittleMemoryForRows_GivesTheSameBytes) {
  const CompiledScene scene = clutter();
  BakeRequest request = shRequest(2, 1, 512);
  const Bake all = run(scene, request).bake;
  Plan plan = makePlan(Scene(), scene, request);
  plan.transportBytes = 8 * 64 * 2000;  // Rows for 2000 receivers fit; the others go through a file.
  plan.recordBytes = 0;
  plan.parks = true;
  Progress progress;
  BakeReport report;
  const Bake few = bakeScene(scene, request, plan, test::sharedDevice(), progress, report);
  EXPECT_NE(std::find_if(report.notes.begin(), report.notes.end(),
                         [](const std::string& note) { return note.find("temporary file") != note.npos; }),
            report.notes.end());
  EXPECT_EQ(few.ao, all.ao);
  ASSERT_TRUE(few.sh && all.sh);
  EXPECT_EQ(few.sh->coefficients, all.sh->coefficients);
}

TEST(Bake, SceneWithoutTriangles_IsRefused) { EXPECT_THROW(run(CompiledScene(), aoRequest(64)), InputError); }

TEST(Bake, StopRequested_Interrupts) {
  struct Stopping : Progress {
    bool stopRequested() const override { return true; }
  } progress;
  const CompiledScene scene = clutter();
  const BakeRequest request = aoRequest(64);
  BakeReport report;
  EXPECT_THROW(
      bakeScene(scene, request, makePlan(Scene(), scene, request), test::sharedDevice(), progress, report),
      Interrupted);
}

}  // namespace
}  // namespace prelight
