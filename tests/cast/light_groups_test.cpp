#include "cast/light_groups.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "prelight/error.h"
#include "support/profiles.h"
#include "support/run_bake.h"
#include "support/scenes.h"

namespace prelight {
namespace {

using std::numbers::pi;

Light pointLight(const std::string& name, const glm::vec3& intensity, const glm::dvec3& position) {
  Light light;
  light.name = name;
  light.intensity = intensity;
  light.position = position;
  return light;
}

BakeRequest groupRequest(int bounces = 0, std::uint64_t rays = 256) {
  BakeRequest request;
  request.lightGroups.wanted = true;
  request.bounces = bounces;
  request.effort.rays = rays;
  return request;
}

TEST(GroupLights, NamedAndOthers_AreDealtInOrder) {
  CompiledScene scene = test::ground(1, 1.0f);
  scene.primitives[0].name = "glowing floor";
  scene.materials[0].emission = {2.0f, 1.0f, 0.0f};
  scene.lights = {pointLight("Lamp.1", {1, 1, 1}, {0, 1, 0}), pointLight("Sun", {3, 3, 3}, {0, 9, 0}),
                  pointLight("Lamp.2", {4, 2, 2}, {1, 1, 0}), pointLight("dark", {0, 0, 0}, {1, 1, 0})};
  const GroupedLights lights = groupLights(scene, {{"lamps", {"Lamp*"}}});
  ASSERT_EQ(lights.groups.size(), 3u);
  EXPECT_EQ(lights.groups[0].name, "lamps");
  EXPECT_EQ(lights.groups[0].color, glm::vec3(4, 2, 2));
  EXPECT_EQ(lights.groups[1].name, "Sun");
  EXPECT_EQ(lights.groups[2].name, "glowing floor");
  EXPECT_EQ(lights.tables.punctual[0].intensity[0], 0.25f);  // Red of Lamp.1.
  EXPECT_EQ(lights.emitters.size(), 2u);
  // The emitter has no blue, but still says where blue would go.
  EXPECT_EQ(lights.emitters[0].factor[2], 1.0f);
}

TEST(GroupLights, GroupWithoutLights_IsNamedWithThoseThatAre) {
  CompiledScene scene = test::ground(1, 1.0f);
  scene.lights = {pointLight("Sun", {3, 3, 3}, {0, 9, 0})};
  try {
    groupLights(scene, {{"lamps", {"Lamp*"}}});
    FAIL() << "an empty group was taken";
  } catch (const UsageError& error) {
    EXPECT_NE(std::string(error.what()).find("lamps"), std::string::npos);
    EXPECT_NE(std::string(error.what()).find("Sun"), std::string::npos);
  }
  scene.lights.clear();
  EXPECT_THROW(groupLights(scene, {}), InputError);
}

TEST(LightGroupBake, PointLightAbovePlane_IsTheInverseSquareLaw) {
  CompiledScene scene = test::ground(40, 1.0f);
  scene.lights = {pointLight("lamp", {5, 3, 1}, {0.0, 1.0, 0.0})};
  const Bake bake = test::runBake(scene, groupRequest()).bake;
  ASSERT_EQ(bake.lightGroups->groups.size(), 1u);
  EXPECT_EQ(bake.lightGroups->groups[0].color, glm::vec3(5, 3, 1));
  for (std::size_t v = 0; v < scene.vertexCount(); ++v) {
    const double r2 = glm::dot(scene.positions[v], scene.positions[v]) + 1.0;
    EXPECT_NEAR(bake.lightGroups->coefficients[v], 1.0 / (pi * r2 * std::sqrt(r2)), 6e-4) << v;
  }
}

TEST(LightGroupBake, LampWithAProfile_SendsByIt) {
  CompiledScene scene = test::ground(40, 1.0f);
  Light lamp = test::profiledLight({0.0, 1.0, 0.0}, test::makeProfile(test::cosineLobe));
  lamp.intensity = {5, 3, 1};
  scene.lights = {lamp};
  const Bake bake = test::runBake(scene, groupRequest()).bake;
  ASSERT_EQ(bake.lightGroups->groups.size(), 1u);
  for (std::size_t v = 0; v < scene.vertexCount(); ++v) {
    const double r2 = glm::dot(scene.positions[v], scene.positions[v]) + 1.0;
    EXPECT_NEAR(bake.lightGroups->coefficients[v], 1.0 / (pi * r2 * r2), 1e-3) << v;
  }
}

TEST(LightGroupBake, Directional_IsTheCosineOverPi) {
  CompiledScene scene = test::ground(3, 1.0f);
  Light sun = pointLight("sun", {1, 1, 1}, {});
  sun.type = LightType::Directional;
  sun.direction = glm::normalize(glm::dvec3(1.0, -1.0, 0.0));
  scene.lights = {sun};
  const Bake bake = test::runBake(scene, groupRequest()).bake;
  for (const float t : bake.lightGroups->coefficients) EXPECT_NEAR(t, std::sqrt(0.5) / pi, 1e-5);
}

/// Form factor of a square that shines down from y = 0.5, from -0.25 to 0.25 about `x` and z = 0, at a point
/// of the plane below (Howell's B-3, four corners).
double squareFormFactor(const glm::dvec3& p, double x) {
  const auto corner = [](double a, double b) {
    const double c = std::sqrt(1 + a * a), d = std::sqrt(1 + b * b);
    return (a / c * std::atan(b / c) + b / d * std::atan(a / d)) / (2 * pi);
  };
  const double h = 0.5, x0 = (x - 0.25 - p.x) / h, x1 = (x + 0.25 - p.x) / h, z0 = (-0.25 - p.z) / h,
               z1 = (0.25 - p.z) / h;
  return corner(x1, z1) - corner(x0, z1) - corner(x1, z0) + corner(x0, z0);
}

void appendSquare(CompiledScene& scene, float x, const glm::vec3& emission) {
  CompiledScene lamp = test::ground(2, 0.25f);
  for (auto& p : lamp.positions) p += glm::vec3(x, 0.5f, 0.0f);
  for (auto& t : lamp.triangles) std::swap(t.y, t.z);  // Makes the lamp shine downwards.
  for (auto& n : lamp.normals) n = -n;
  test::append(scene, lamp);
  scene.materials.back().emission = emission;
}

TEST(LightGroupBake, SquareEmittersAbovePlane_AreTheirFormFactors) {
  CompiledScene scene = test::ground(24, 0.6f);
  appendSquare(scene, -0.3f, {7.0f, 7.0f, 7.0f});
  appendSquare(scene, 0.3f, {2.0f, 1.0f, 3.0f});
  const Bake bake = test::runBake(scene, groupRequest(0, 1024)).bake;
  ASSERT_EQ(bake.lightGroups->groups.size(), 2u);
  for (std::size_t group = 0; group < 2; ++group) {
    double worst = 0.0, squares = 0.0;
    for (std::size_t v = 0; v < 25 * 25; ++v) {
      const double expected = squareFormFactor(scene.positions[v], group == 0 ? -0.3 : 0.3);
      const double error = bake.lightGroups->coefficients[2 * v + group] - expected;
      worst = std::max(worst, std::abs(error));
      squares += error * error;
    }
    EXPECT_LT(std::sqrt(squares / 625.0), 0.002) << group;
    EXPECT_LT(worst, 0.012) << group;
  }
}

TEST(LightGroupBake, BlockerBetween_CastsItsShadow) {
  CompiledScene scene = test::ground(20, 1.0f);
  test::append(scene, test::box(2, {-0.2f, 0.4f, -0.2f}, {0.2f, 0.5f, 0.2f}, false));
  scene.lights = {pointLight("lamp", {1, 1, 1}, {0.0, 1.0, 0.0})};
  const Bake bake = test::runBake(scene, groupRequest()).bake;
  // The box's upper edge casts a shadow up to 0.2 / (1 - 0.5), four tenths of a metre from the middle.
  for (std::size_t v = 0; v < 21 * 21; ++v) {
    const double reach = std::max(std::abs(scene.positions[v].x), std::abs(scene.positions[v].z));
    const double r2 = glm::dot(scene.positions[v], scene.positions[v]) + 1.0;
    if (reach > 0.25 && reach < 0.65) continue;
    const double expected = reach < 0.25 ? 0.0 : 1.0 / (pi * r2 * std::sqrt(r2));
    EXPECT_NEAR(bake.lightGroups->coefficients[v], expected, 0.02) << v;
  }
}

// Walls of radiance 1 and albedo a, seen from within: a point receives (1 + a + a^2 + ...) pi.
TEST(LightGroupBake, GlowingRoom_IsAFurnaceOfGeometricSums) {
  CompiledScene scene = test::box(5, {-1, -1, -1}, {1, 1, 1}, true);
  scene.materials[0].albedo = {0.5f, 0.25f, 0.0f};
  scene.materials[0].emission = {3.0f, 3.0f, 3.0f};
  const Bake direct = test::runBake(scene, groupRequest(0)).bake;
  double sum = 0.0, squares = 0.0;
  for (const float t : direct.lightGroups->coefficients) {
    sum += t - 1.0;
    squares += (t - 1.0) * (t - 1.0);
  }
  EXPECT_NEAR(sum / scene.vertexCount(), 0.0, 0.003);
  EXPECT_LT(std::sqrt(squares / scene.vertexCount()), 0.02);
  const Bake bake = test::runBake(scene, groupRequest(3)).bake;
  ASSERT_EQ(bake.lightGroups->channels, 3);
  EXPECT_EQ(bake.lightGroups->groups[0].color, glm::vec3(3.0f));
  double mean[3] = {};
  for (std::size_t v = 0; v < scene.vertexCount(); ++v)
    for (std::size_t c = 0; c < 3; ++c)
      mean[c] += double(bake.lightGroups->coefficients[3 * v + c]) / scene.vertexCount();
  EXPECT_NEAR(mean[0], 1.0 + 0.5 + 0.25 + 0.125, 0.01);
  EXPECT_NEAR(mean[1], 1.0 + 0.25 + 0.0625 + 0.015625, 0.01);
  EXPECT_NEAR(mean[2], 1.0, 0.01);
}

TEST(LightGroupBake, TwoGroups_AddUpToOneOfBoth) {
  // A convex room has no shadow edges, where a fit would dip below 0 and be clipped.
  CompiledScene scene = test::box(6, {-1, -1, -1}, {1, 1, 1}, true);
  scene.materials[0].albedo = glm::vec3(0.7f);
  scene.lights = {pointLight("a", {2, 2, 2}, {0.2, 0.1, 0.0}), pointLight("b", {4, 4, 4}, {-0.2, 0.3, 0.2})};
  const Bake apart = test::runBake(scene, groupRequest(1)).bake;
  BakeRequest request = groupRequest(1);
  request.lightGroups.named = {{"both", {"a", "b"}}};
  const Bake together = test::runBake(scene, request).bake;
  ASSERT_EQ(apart.lightGroups->groups.size(), 2u);
  ASSERT_EQ(together.lightGroups->groups.size(), 1u);
  for (std::size_t i = 0; i < together.lightGroups->coefficients.size(); ++i)
    EXPECT_NEAR(
        4.0f * together.lightGroups->coefficients[i],
        2.0f * apart.lightGroups->coefficients[2 * i] + 4.0f * apart.lightGroups->coefficients[2 * i + 1],
        2e-4);
}

}  // namespace
}  // namespace prelight
