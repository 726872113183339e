#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <span>
#include <vector>

#include "basis/sh.h"
#include "basis/sh_zonal.h"
#include "compress/small_floats.h"
#include "gpu/tracer.h"
#include "oracle/brute_force.h"
#include "scene/builtin/builtin.h"
#include "scene/gltf/load/loader.h"
#include "support/run_bake.h"
#include "support/scenes.h"
#include "techniques/near_lamps/lamp_shells.h"

namespace prelight {
namespace {

BakeRequest shellRequest(int order, int shells, std::uint64_t rays = 512) {
  BakeRequest request;
  request.sh.order = order;
  request.nearLamps.shells = shells;
  request.effort.rays = rays;
  return request;
}

CompiledScene builtinScene(const char* name) {
  Warnings warnings;
  return compileScene(loadScene(makeBuiltinScene(name), warnings), warnings);
}

std::uint32_t vertexNearest(const CompiledScene& scene, const glm::vec3& place) {
  std::uint32_t nearest = 0;
  for (std::uint32_t v = 0; v < scene.vertexCount(); ++v)
    if (glm::distance(scene.positions[v], place) < glm::distance(scene.positions[nearest], place))
      nearest = v;
  return nearest;
}

std::vector<double> shellOf(const NearLampTransfer& transfer, std::size_t vertex, std::size_t shell) {
  std::vector<double> values;
  for (std::size_t i = 0; i < transfer.columns(); ++i)
    values.push_back(fromHalf(
        transfer
            .halves[(vertex * static_cast<std::size_t>(transfer.shells) + shell) * transfer.columns() + i]));
  return values;
}

/// A floor at y = 0 with a ceiling 1 m above it, both 8 m wide.
CompiledScene underCeiling() {
  CompiledScene scene = test::ground(16, 4.0f);
  test::append(scene, test::ground(4, 4.0f, 1.0f));
  scene.boundsMin = {-4, 0, -4};
  scene.boundsMax = {4, 1, 4};
  return scene;
}

TEST(NearLamps, PlaneAboveFloor_ShadowsWhatIsBehindItAlone) {
  const CompiledScene scene = underCeiling();
  const Bake bake = test::runBake(scene, shellRequest(6, 8)).bake;
  const std::uint32_t middle = vertexNearest(scene, {0, 0, 0});
  const auto from = [&](double distance) {
    return lampVisibility(*bake.nearLamps, middle, {0, 1, 0}, {0, 1, 0}, distance);
  };
  EXPECT_NEAR(from(0.3), 1.0, 0.02);
  EXPECT_NEAR(from(0.6), 1.0, 0.1);
  EXPECT_NEAR(from(11.0), 0.0, 0.05);
  // Truncated bands ring: shells of surfaces to the side and farther away change this by some hundredths
  // either way (0.06 at 4 m, with any number of rays).
  for (double distance = 2.0; distance < 11.0; distance *= 1.1)
    EXPECT_NEAR(from(distance), 0.0, 0.1) << distance;
}

TEST(NearLamps, ClosedBox_HasAllOfTheHemisphereInItsShells) {
  const CompiledScene scene = test::box(4, {-1, -1, -1}, {1, 2, 1}, true);
  const Bake bake = test::runBake(scene, shellRequest(4, 6)).bake;
  std::vector<double> open(16);
  for (std::uint32_t v = 0; v < scene.vertexCount(); ++v) {
    sh::openTransfer(glm::normalize(glm::dvec3(scene.normals[v])), 4, open);
    std::vector<double> sum(16, 0.0);
    for (std::size_t shell = 0; shell < 6; ++shell)
      for (std::size_t i = 0; i < 16; ++i) sum[i] += shellOf(*bake.nearLamps, v, shell)[i];
    for (std::size_t i = 0; i < 16; ++i) EXPECT_NEAR(sum[i], open[i], 2e-3) << v << " " << i;
  }
}

TEST(NearLamps, SurfacesThatLetLightThrough_ShareTheHemisphereBetweenShellsAndTransfer) {
  CompiledScene scene = test::box(4, {-1, -1, -1}, {1, 2, 1}, true);
  BakeRequest request = shellRequest(4, 6);
  request.limits.obscurance = 2.0;
  const Bake bake = test::runBake(scene, request).bake;
  ASSERT_EQ(bake.sh->channels, 1);
  std::vector<double> open(16);
  double blocked = 0.0;
  for (std::uint32_t v = 0; v < scene.vertexCount(); ++v) {
    sh::openTransfer(glm::normalize(glm::dvec3(scene.normals[v])), 4, open);
    for (std::size_t i = 0; i < 16; ++i) {
      double sum = 0.0;
      for (std::size_t shell = 0; shell < 6; ++shell) sum += shellOf(*bake.nearLamps, v, shell)[i];
      EXPECT_NEAR(sum + double(bake.sh->coefficients[v * 16 + i]), open[i], 2e-3) << v << " " << i;
      if (i == 0) blocked += sum / (open[0] * scene.vertexCount());
    }
  }
  EXPECT_GT(blocked, 0.2);
  EXPECT_LT(blocked, 0.8);
}

/// Reference shells of a place from cosine-weighted rays in double precision: (1/pi) integral cos Y_i of
/// each.
std::vector<std::vector<double>> referenceShells(const CompiledScene& scene, const NearLampTransfer& transfer,
                                                 const glm::dvec3& place, const glm::dvec3& normal) {
  constexpr int side = 96;
  const glm::dvec3 x = glm::normalize(glm::cross(normal, glm::dvec3(0.3, 0.5, 0.8))),
                   z = glm::cross(x, normal);
  std::vector<std::vector<double>> shells(static_cast<std::size_t>(transfer.shells),
                                          std::vector<double>(transfer.columns(), 0.0));
  std::vector<double> basis(transfer.columns());
  for (int i = 0; i < side * side; ++i) {
    const double u = (i / side + 0.5) / side, angle = 2.0 * std::numbers::pi * (i % side + 0.5) / side;
    const glm::dvec3 way =
        std::sqrt(u) * (std::cos(angle) * x + std::sin(angle) * z) + std::sqrt(1.0 - u) * normal;
    const auto hit = reference::closestHit(scene, place, way, 1e9, 0xffffffffu);
    if (!hit) continue;
    std::size_t shell = 0;
    while (shell + 1 < shells.size() && hit->t >= shellStart(transfer, static_cast<int>(shell) + 1)) ++shell;
    sh::evaluate(way, transfer.order, basis);
    for (std::size_t k = 0; k < basis.size(); ++k) shells[shell][k] += basis[k] / (side * side);
  }
  return shells;
}

TEST(NearLamps, ShellsOfABoxAndABall_AreThoseOfRaysInDoublePrecision) {
  CompiledScene scene = test::box(8, {-1, -1, -1}, {1, 1, 1}, true);
  test::append(scene, test::sphere(12, 0.3f, {0.2f, -0.2f, 0.1f}));
  const Bake bake = test::runBake(scene, shellRequest(5, 8, 2048)).bake;
  for (const glm::vec3& place : {glm::vec3(0, -1, 0), glm::vec3(1, 0.25f, 0.25f)}) {
    const std::uint32_t v = vertexNearest(scene, place);
    const glm::dvec3 normal = glm::normalize(glm::dvec3(scene.normals[v]));
    const auto expected =
        referenceShells(scene, *bake.nearLamps, glm::dvec3(scene.positions[v]) + 1e-5 * normal, normal);
    for (std::size_t shell = 0; shell < expected.size(); ++shell) {
      const std::vector<double> got = shellOf(*bake.nearLamps, v, shell);
      for (std::size_t i = 0; i < got.size(); ++i)
        EXPECT_NEAR(got[i], expected[shell][i], 0.02) << shell << " " << i;
    }
  }
}

TEST(NearLamps, AskedFor_ChangeNeitherRaysNorTransfer) {
  const CompiledScene scene = builtinScene("rooms");
  BakeRequest with = shellRequest(3, 8, 128), without = shellRequest(3, 0, 128);
  with.bounces = without.bounces = 1;
  const test::BakeResult shells = test::runBake(scene, with), plain = test::runBake(scene, without);
  EXPECT_EQ(shells.report.rays, plain.report.rays);
  EXPECT_EQ(shells.report.receivers, plain.report.receivers);
  EXPECT_EQ(shells.bake.sh->coefficients, plain.bake.sh->coefficients);
  EXPECT_TRUE(shells.bake.nearLamps.has_value());
  EXPECT_FALSE(plain.bake.nearLamps.has_value());
}

std::string reasonOf(const Plan& plan) {
  for (const PlannedPass& pass : plan.passes)
    if (pass.name == Pass::NearLamps.name) return pass.reason;
  return "no pass";
}

TEST(NearLamps, Plan_SaysWhyTheyRunOrAreSkipped) {
  const CompiledScene rooms = builtinScene("rooms");
  const Plan runs = makePlan(Scene(), rooms, shellRequest(6, 8));
  EXPECT_TRUE(runs.runs(Pass::NearLamps));
  EXPECT_NE(reasonOf(runs).find("8 shells"), std::string::npos) << reasonOf(runs);
  EXPECT_NE(reasonOf(makePlan(Scene(), rooms, shellRequest(6, 0))).find("not asked for"), std::string::npos);
  BakeRequest noBands = shellRequest(0, 8);
  noBands.ao = true;
  const Plan without = makePlan(Scene(), rooms, noBands);
  EXPECT_FALSE(without.runs(Pass::NearLamps));
  EXPECT_NE(reasonOf(without).find("none is asked for"), std::string::npos) << reasonOf(without);
  CompiledScene flat = test::ground(2, 1.0f);
  flat.boundsMin = {-1, 0, -1};
  flat.boundsMax = {1, 0, 1};
  const Plan skipped = makePlan(Scene(), flat, shellRequest(3, 8));
  EXPECT_FALSE(skipped.runs(Pass::NearLamps));
  EXPECT_NE(reasonOf(skipped).find("flat"), std::string::npos) << reasonOf(skipped);
  EXPECT_FALSE(test::runBake(flat, shellRequest(3, 8, 16)).bake.nearLamps.has_value());
}

TEST(NearLamps, NotGiven_ArePlannedWhereALampLiesWithin) {
  BakeRequest request;
  request.ao = true;
  request.sh.order = 3;
  const CompiledScene rooms = builtinScene("rooms"), shapes = builtinScene("shapes");
  const Plan lit = makePlan(Scene(), rooms, request);
  EXPECT_TRUE(lit.runs(Pass::NearLamps));
  EXPECT_NE(reasonOf(lit).find("light 'Light'"), std::string::npos) << reasonOf(lit);
  EXPECT_NE(reasonOf(makePlan(Scene(), builtinScene("cornell"), request)).find("emissive surfaces"),
            std::string::npos);
  EXPECT_EQ(reasonOf(makePlan(Scene(), shapes, request)), "no pass");  // its lamp hangs above
  request.sh.order = 0;
  EXPECT_EQ(reasonOf(makePlan(Scene(), rooms, request)), "no pass");
  request.haar.size = 8;
  EXPECT_TRUE(makePlan(Scene(), rooms, request).runs(Pass::NearLamps));
}

TEST(NearLamps, NotGiven_AreBakedInTheUsualShellsOrNotAtAll) {
  BakeRequest request;
  request.haar.size = 4;
  request.effort.rays = 16;
  const test::BakeResult lit = test::runBake(builtinScene("rooms"), request);
  ASSERT_TRUE(lit.bake.nearLamps.has_value());
  EXPECT_EQ(lit.bake.nearLamps->shells, BakeRequest::usualShells);
  EXPECT_FALSE(test::runBake(builtinScene("shapes"), request).bake.nearLamps.has_value());
  request.nearLamps.shells = 0;
  EXPECT_FALSE(test::runBake(builtinScene("rooms"), request).bake.nearLamps.has_value());
}

/// A random point of the surface.
struct LitPoint {
  std::uint32_t triangle = 0;
  glm::dvec3 weights{0.0}, position{0.0}, normal{0.0};
};

std::vector<LitPoint> litPoints(const CompiledScene& scene, int count) {
  std::vector<double> areas;
  for (std::uint32_t t = 0; t < scene.triangleCount(); ++t)
    areas.push_back(glm::length(geometricNormal(scene, t)));
  std::mt19937 random(5);
  std::discrete_distribution<std::uint32_t> triangles(areas.begin(), areas.end());
  std::uniform_real_distribution<double> number(0.0, 1.0);
  std::vector<LitPoint> points;
  for (int i = 0; i < count; ++i) {
    LitPoint point;
    point.triangle = triangles(random);
    const double root = std::sqrt(number(random)), v = number(random);
    point.weights = {1.0 - root, root * (1.0 - v), root * v};
    for (int k = 0; k < 3; ++k) {
      const std::uint32_t vertex = scene.triangles[point.triangle][k];
      point.position += point.weights[k] * glm::dvec3(scene.positions[vertex]);
      point.normal += point.weights[k] * glm::dvec3(scene.normals[vertex]);
    }
    point.normal = glm::normalize(point.normal);
    points.push_back(point);
  }
  return points;
}

double visibilityAt(const CompiledScene& scene, const NearLampTransfer& transfer, const LitPoint& point,
                    const glm::dvec3& lamp) {
  double visibility = 0.0;
  for (int k = 0; k < 3; ++k) {
    const std::uint32_t v = scene.triangles[point.triangle][k];
    const glm::dvec3 path = lamp - glm::dvec3(scene.positions[v]);
    visibility += point.weights[k] * lampVisibility(transfer, v, glm::normalize(glm::dvec3(scene.normals[v])),
                                                    glm::normalize(path), glm::length(path));
  }
  return sharpened(visibility);
}

/// Root mean square error of a lamp's light with shadows by shells, relative to that without shadows. Both
/// are compared with traced shadow rays. `place` is in world space.
double lampError(const CompiledScene& scene, const NearLampTransfer& transfer, const glm::dvec3& place) {
  const glm::dvec3 lamp = place - scene.origin;
  const std::vector<LitPoint> points = litPoints(scene, 600);
  std::vector<device::Ray> rays;
  for (const LitPoint& point : points) {
    const glm::dvec3 from = point.position + 1e-5 * point.normal, way = lamp - from;
    rays.push_back({{float(from.x), float(from.y), float(from.z)},
                    point.triangle,
                    {float(way.x), float(way.y), float(way.z)},
                    0.999f});
  }
  Tracer tracer(scene, test::sharedDevice());
  const std::vector<device::Hit> hits = tracer.traceAny(rays);
  double withShells = 0.0, without = 0.0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const glm::dvec3 path = lamp - points[i].position;
    const double distance = glm::length(path);
    const double open = std::max(0.0, glm::dot(points[i].normal, path)) / std::pow(distance, 3);
    const double truth = hits[i].triangle == PRELIGHT_NO_TRIANGLE ? open : 0.0;
    withShells += std::pow(open * visibilityAt(scene, transfer, points[i], lamp) - truth, 2);
    without += std::pow(open - truth, 2);
  }
  return std::sqrt(withShells / without);
}

TEST(NearLamps, InRoomsAndABox_HalveTheErrorOfLightWithoutShadows) {
  const CompiledScene rooms = builtinScene("rooms"), cornell = builtinScene("cornell");
  const Bake ofRooms = test::runBake(rooms, shellRequest(6, 8, 256)).bake;
  EXPECT_LT(lampError(rooms, *ofRooms.nearLamps, {-1.9, 2.2, 0.4}), 0.4) << "the file's lamp";
  EXPECT_LT(lampError(rooms, *ofRooms.nearLamps, {2.0, 1.5, 0.5}), 0.4) << "in the other room";
  EXPECT_LT(lampError(rooms, *ofRooms.nearLamps, {-4.0, 1.3, 0.0}), 0.5) << "near a wall";
  EXPECT_LT(lampError(rooms, *ofRooms.nearLamps, {-2.0, 0.1, 0.8}), 0.5) << "near the floor";
  const Bake ofCornell = test::runBake(cornell, shellRequest(6, 8, 256)).bake;
  EXPECT_LT(lampError(cornell, *ofCornell.nearLamps, {0.0, 1.8, 0.0}), 0.4) << "below the ceiling";
  EXPECT_LT(lampError(cornell, *ofCornell.nearLamps, {0.0, 1.0, 0.2}), 0.45) << "in the middle";
}

TEST(NearLamps, LampWithoutDistance_HasNothingBeforeIt) {
  const NearLampTransfer transfer{1, 2, 0.1, 1.0, {}};
  EXPECT_EQ(shareBefore(transfer, 0, 0.0), 0.0);
  EXPECT_EQ(shareBefore(transfer, 0, 1e9), 1.0);
  EXPECT_NEAR(shareBefore(transfer, 0, shellStart(transfer, 1)), 0.5, 1e-12);
}

}  // namespace
}  // namespace prelight
