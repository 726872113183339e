// Screen-space light around occluders, and its bounces, compared with closed forms and with traced light.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <numbers>
#include <string>
#include <vector>

#include "benchmarks/truth/traced_accessibility.h"
#include "prelight/load.h"
#include "support/devices.h"
#include "viewer/corner_scene.h"
#include "viewer/frame/view.h"
#include "viewer/techniques/screen/occlusion_band.h"

namespace prelight {
namespace {

using namespace test;
using viewer::OcclusionMethod;
using viewer::ScreenOcclusionOptions;

using std::numbers::pi;

ScreenOcclusionOptions light(double radius, int bounces) {
  ScreenOcclusionOptions options = within(radius, OcclusionMethod::Ssdo);
  options.bounces = bounces;
  return options;
}

/// Irradiance over pi on a floor under a sky of radiance `sky`. A wall at a distance in +X hides the
/// directions that hit its plane within `radius`; midpoint rule.
template <typename Sky>
double lightBeforeWall(double distance, double radius, Sky sky) {
  const int steps = 800;
  double sum = 0.0;
  for (int i = 0; i < steps; ++i)
    for (int j = 0; j < steps; ++j) {
      const double azimuth = 2.0 * pi * (i + 0.5) / steps, height = 0.5 * pi * (j + 0.5) / steps;
      const double x = std::cos(height) * std::cos(azimuth), z = std::sin(height);
      if (radius * x > distance) continue;
      sum += std::cos(height) * z * sky(glm::dvec3(x, std::cos(height) * std::sin(azimuth), z));
    }
  const double cell = (2.0 * pi / steps) * (0.5 * pi / steps);
  return sum * cell / pi;
}

/// A sky with `sky` of the direction in red and 0 elsewhere.
template <typename Sky>
Environment skyOf(Sky sky) {
  Environment map{128, 64, {}};
  for (int row = 0; row < map.height; ++row)
    for (int column = 0; column < map.width; ++column)
      map.radiance.emplace_back(static_cast<float>(
          sky(Environment::direction((column + 0.5) / map.width, (row + 0.5) / map.height))));
  return map;
}

double gradient(const glm::dvec3& w) { return 1.0 + 0.9 * w.x; }

TEST(ScreenLight, CornerUnderAGradientSky_IsTheDoubleIntegral) {
  QuadScene corner = smallCorner();
  corner.setSky(skyOf(gradient));
  const Picture picture = corner.render(screenOptions(160, light(0.5, 0)));
  for (const double distance : {0.05, 0.1, 0.2, 0.3, 0.6})
    for (const double y : {-0.3, 0.2})
      // The tolerance is that of accessibility times the hidden radiance.
      EXPECT_NEAR(pixelOf(picture, corner, {-distance, y, 0}).r, lightBeforeWall(distance, 0.5, gradient),
                  0.03 * gradient({1, 0, 0}))
          << distance << " " << y;
}

TEST(ScreenLight, WallsFoot_LosesTheLightOfTheWallsSideAlone) {
  QuadScene corner = smallCorner();
  corner.setSky(halvedSky());  // +X is red, -X green; the wall is at +X.
  const Picture picture = corner.render(screenOptions(128, light(0.5, 0)));
  const auto red = [](const glm::dvec3& w) { return w.x > 0.0 ? 1.0 : 0.0; };
  for (const double distance : {0.05, 0.1, 0.3, 1.0}) {
    const glm::vec3 found = pixelOf(picture, corner, {-distance, 0, 0});
    EXPECT_NEAR(found.r, lightBeforeWall(distance, 0.5, red), 0.04) << distance;
    EXPECT_NEAR(found.g, 0.5, 0.04) << distance;
  }
}

TEST(ScreenLight, OpenPlane_ReceivesTheWholeSkyAndNoBounce) {
  QuadScene plane;
  plane.add(lambertian(glm::vec3(1)), 30.0f);
  plane.setSky(halvedSky());
  plane.lookFrom({0.4, -1.4, 1.6}, {0, 0, 0});
  plane.compile();
  for (const glm::vec3& pixel : plane.render(screenOptions(48, light(1.0, 1))).pixels)
    for (int channel = 0; channel < 3; ++channel) EXPECT_NEAR(pixel[channel], 0.5f, 0.01f);
}

/// The corner without a sky, lit by a directional light.
QuadScene lampCorner(const glm::dvec3& way, const glm::vec3& irradiance) {
  QuadScene corner = smallCorner();
  corner.hasEnvironment = false;
  corner.scene.lights = {makeLight(LightType::Directional, irradiance, {}, way)};
  corner.compile();
  return corner;
}

TEST(ScreenLight, LightAlongTheFloor_BouncesOffTheWallByTheClosedForm) {
  // Only the wall is lit, and evenly. The part of the floor's sky that it hides within the radius shows the
  // wall.
  const QuadScene corner = lampCorner({1, 0, 0}, glm::vec3(2.0f, 1.0f, 0.0f));
  const Picture picture = corner.render(screenOptions(160, light(0.5, 1)));
  for (const double distance : {0.05, 0.1, 0.2, 0.3, 0.6})
    for (const double y : {-0.3, 0.2}) {
      const glm::vec3 found = pixelOf(picture, corner, {-distance, y, 0});
      const double hidden = 1.0 - openBeforeWall(distance, 0.5);
      EXPECT_NEAR(found.r, 2.0 / pi * hidden, 0.02) << distance << " " << y;
      EXPECT_NEAR(found.g, 1.0 / pi * hidden, 0.01) << distance << " " << y;
      EXPECT_EQ(found.b, 0.0f);
    }
  const Picture without = corner.render(screenOptions(64, light(0.5, 0)));
  EXPECT_EQ(pixelOf(without, corner, {-0.1, 0, 0}).r, 0.0f);
}

/// A floor, and a two-sided card of height 0.2 m that stands on it at x = 0.
QuadScene standingCard() {
  QuadScene scene;
  scene.add(lambertian(glm::vec3(1)), 5.0f);
  Material white = lambertian(glm::vec3(1));
  white.doubleSided = true;
  glm::dmat4 place = glm::translate(glm::dmat4(1.0), glm::dvec3(0, 0, -0.8));
  scene.add(white, 1.0f, glm::rotate(place, -0.5 * pi, glm::dvec3(0, 1, 0)));
  scene.lookFrom({-1.2, -1.5, 1.8}, {-0.2, 0, 0});
  return scene;
}

TEST(ScreenLight, Lamp_IsShadowedWithinTheRadiusAlone) {
  QuadScene scene = standingCard();
  // The light comes from +X at 45 degrees: the shadow ends 0.2 m in front of the card.
  scene.scene.lights = {makeLight(LightType::Directional, glm::vec3(3), {}, {-1, 0, -1})};
  scene.compile();
  const double lit = 3.0 / pi * std::sqrt(0.5);
  const auto rendered = [&](double radius) {
    viewer::RenderOptions options = screenOptions(160, light(radius, 0));
    options.direct = LampShadows::Baked;
    return scene.render(options);
  };
  const Picture picture = rendered(0.5);
  for (const double distance : {0.06, 0.1, 0.14})
    EXPECT_NEAR(pixelOf(picture, scene, {-distance, 0, 0}).r, 0.0, 0.1) << distance;
  for (const double distance : {0.27, 0.4, 0.7})
    EXPECT_NEAR(pixelOf(picture, scene, {-distance, 0, 0}).r, lit, 0.03) << distance;
  EXPECT_NEAR(pixelOf(picture, scene, {0.3, 0, 0}).r, lit, 0.03) << "on the lamp's side";
  const Picture shorter = rendered(0.05);
  EXPECT_NEAR(pixelOf(shorter, scene, {-0.1, 0, 0}).r, lit, 0.03) << "farther than the radius";
}

TEST(ScreenLight, PointLightBeforeAWall_IsNotHiddenByIt) {
  QuadScene corner = smallCorner();
  corner.hasEnvironment = false;
  corner.scene.lights = {makeLight(LightType::Point, glm::vec3(1), {-0.1, 0, 0.2})};
  corner.compile();
  const Picture picture = corner.render(screenOptions(160, light(0.6, 0)));
  for (const double distance : {0.2, 0.3, 0.4}) {
    const glm::dvec3 path(distance - 0.1, 0, 0.2);
    const double lit = 0.2 / std::pow(glm::length(path), 3.0) / pi;
    EXPECT_NEAR(pixelOf(picture, corner, {-distance, 0, 0}).r, lit, 0.12 * lit)
        << distance;  // May be off by a pixel.
  }
}

glm::vec3 coloured(const glm::dvec3& w) {
  return {w.x > 0.0 ? 1.0f : 0.0f, w.x < 0.0 ? 1.0f : 0.0f, w.y > 0.0 ? 1.0f : 0.0f};  // As halvedSky().
}

/// A built-in scene in white under halvedSky() with the default radius.
struct ColouredScene {
  explicit ColouredScene(const std::string& name)
      : scene(benchmarks::whitened(loadBuiltin(name).scene)), compiled(compileScene(scene, warnings)) {}

  std::vector<glm::vec3> drawn(const ScreenOcclusionOptions& occlusion) const {
    Warnings notes;
    return viewer::renderPicture(inputs(), options(occlusion), notes).pixels;
  }
  viewer::RenderOptions options(const ScreenOcclusionOptions& occlusion) const {
    viewer::RenderOptions options = screenOptions(90, occlusion);
    options.width = 160;
    return options;
  }
  viewer::RenderInputs inputs() const { return {scene, compiled, nullptr, &sky}; }
  benchmarks::AccessibilityRequest request(int rays) const {
    const viewer::View view = viewer::makeView(inputs(), options({}));
    return {view.camera, view.width, view.height, viewer::occlusionRadius({}, compiled), rays};
  }

  Warnings warnings;
  Scene scene;
  CompiledScene compiled;
  Environment sky = halvedSky();
};

TEST(ScreenLight, UnderATwoColouredSky_IsNearerToTracedLightThanGtao) {
  for (const char* name : {"shapes", "rooms", "cornell"}) {
    const ColouredScene scene(name);
    Tracer tracer(scene.compiled, sharedDevice());
    const std::vector<glm::vec3> traced =
        benchmarks::tracedSkyLight(scene.compiled, tracer, scene.request(128), coloured);
    const double error = benchmarks::lightError(scene.drawn(light(0.0, 0)), traced);
    EXPECT_LT(error, benchmarks::lightError(scene.drawn({}), traced)) << name;
    EXPECT_LT(error, 0.05) << name;
  }
}

TEST(ScreenLight, Bounce_IsNearerToOneTracedBounceThanNone) {
  for (const char* name : {"shapes", "cornell"}) {
    const ColouredScene scene(name);
    Tracer tracer(scene.compiled, sharedDevice());
    const std::vector<glm::vec3> traced =
        benchmarks::tracedBounce(scene.compiled, tracer, scene.request(32), coloured, 16);
    std::vector<glm::vec3> bounce = scene.drawn(light(0.0, 1));
    const std::vector<glm::vec3> direct = scene.drawn(light(0.0, 0));
    for (std::size_t i = 0; i < bounce.size(); ++i) bounce[i] -= direct[i];
    const double none = benchmarks::lightError(std::vector<glm::vec3>(traced.size(), glm::vec3(0)), traced);
    EXPECT_LT(benchmarks::lightError(bounce, traced), 0.6 * none) << name;
  }
}

}  // namespace
}  // namespace prelight
