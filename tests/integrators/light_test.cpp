#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <string>

#include "gpu/light_tables.h"
#include "prelight/error.h"
#include "scene/light_shape.h"
#include "support/shot.h"

// Light from each kind of light source, against closed forms.
namespace prelight::test {
namespace {

using reference::Estimator;
using reference::Film;
using reference::Integrator;

using std::numbers::pi;

/// A white Lambertian floor, seen from straight above within a tiny area around `target`.
Shot floorShot(const glm::dvec3& target, const std::vector<Light>& lights) {
  Shot shot = shotOf(ground(1, 10.0f), orthographicCamera(target + glm::dvec3(0, 1, 0), target, 1e-3), 2, 32);
  shot.scene.materials[0] = lambert(1.0f);
  shot.lights = lights;
  shot.request.depth = 2;
  return shot;
}

double radianceOf(const Shot& shot) { return meanOf(shot.render()).mean; }

Light pointLight(const glm::dvec3& position, float intensity) {
  Light light;
  light.type = LightType::Point;
  light.position = position;
  light.intensity = glm::vec3(intensity);
  return light;
}

constexpr std::array integrators{Integrator::Path, Integrator::Whitted, Integrator::Distributed};

TEST(PointLight, Floor_FollowsTheInverseSquare) {
  for (const Integrator integrator : integrators)
    for (const double x : {0.0, 1.0, 3.0}) {
      Shot shot = floorShot({0, 0, 0}, {pointLight({x, 2, 0}, 7.0f)});
      shot.request.integrator = integrator;
      const double distance2 = x * x + 4.0;
      EXPECT_NEAR(radianceOf(shot), 7.0 / pi * 2.0 / std::pow(distance2, 1.5), 1e-3 * 7.0 / (pi * distance2));
    }
}

Light diskLight(double height, double radius, float radiance) {
  Light light;
  light.type = LightType::Area;
  light.name = "disk";
  light.position = {0, height, 0};
  light.direction = {0, -1, 0};
  light.side = {1, 0, 0};
  light.intensity = glm::vec3(radiance);
  light.shape = std::make_shared<const LightShape>(LightShape{ShapeKind::Disk, radius});
  return light;
}

/// A white floor of 20 m.
Scene whiteFloor() {
  Scene scene;
  Material white;
  white.metallic = white.specular = 0.0f;
  scene.materials.push_back(white);
  Primitive floor;
  floor.positions = {{-10, 0, 10}, {10, 0, 10}, {10, 0, -10}, {-10, 0, -10}};
  floor.triangles = {{0, 1, 2}, {0, 2, 3}};
  floor.material = 0;
  scene.meshes.push_back({"floor", {floor}});
  scene.nodes.emplace_back();
  MeshNode node;
  node.transforms = {glm::dmat4(1.0)};
  scene.meshNodes.push_back(node);
  return scene;
}

TEST(AreaLight, SurfaceOfADisk_LightsAFloorAsTheClosedForm) {
  Scene scene = whiteFloor();
  Shot shot = floorShot({0, 0, 0}, {diskLight(2.0, 1.0, 5.0f)});
  ASSERT_TRUE(makeSurfacesOf(shot.lights, scene));
  Warnings warnings;
  shot.scene = compileScene(scene, warnings);
  shot.request.samples = 1024;
  const double expected = 5.0 / (1.0 + 4.0);  // R^2 / (R^2 + d^2).
  EXPECT_NEAR(radianceOf(shot), expected, 0.01 * expected);
}

TEST(AreaLight, GivenToWhatTraces_IsAnErrorThatSaysWhatToDo) {
  try {
    radianceOf(floorShot({0, 0, 0}, {diskLight(2.0, 1.0, 5.0f)}));
    ADD_FAILURE() << "it was traced";
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("emissive surface"), std::string::npos) << error.what();
  }
}

TEST(PointLight, Range_WindowsTheFalloff) {
  Light light = pointLight({0, 2, 0}, 7.0f);
  light.range = 3.0f;
  EXPECT_NEAR(radianceOf(floorShot({0, 0, 0}, {light})), 7.0 / (4.0 * pi) * (1.0 - std::pow(2.0 / 3.0, 4.0)),
              1e-4);
  light.range = 1.9f;
  EXPECT_EQ(radianceOf(floorShot({0, 0, 0}, {light})), 0.0);
}

TEST(PointLight, Several_AddUp) {
  for (const Integrator integrator : integrators) {
    Shot shot = floorShot(
        {0, 0, 0}, {pointLight({0, 2, 0}, 4.0f), pointLight({0, 1, 0}, 0.5f), pointLight({0, 3, 0}, 90.0f)});
    shot.request.integrator = integrator;
    shot.request.samples = integrator == Integrator::Whitted ? 32 : 8192;
    EXPECT_NEAR(radianceOf(shot), (1.0 + 0.5 + 10.0) / pi, 1e-2 * 11.5 / pi);
  }
}

TEST(DirectionalLight, Floor_FollowsTheCosine) {
  Light light;
  light.type = LightType::Directional;
  light.direction = glm::normalize(glm::dvec3(1, -2, 0.5));
  light.intensity = {3.0f, 3.0f, 3.0f};
  EXPECT_NEAR(radianceOf(floorShot({0, 0, 0}, {light})), 3.0 / pi * -light.direction.y, 1e-4);
}

TEST(SpotLight, Falloff_IsTheExtensionsFormula) {
  Light light = pointLight({0, 2, 0}, 5.0f);
  light.type = LightType::Spot;
  light.direction = {0, -1, 0};
  light.innerConeAngle = 0.3f;
  light.outerConeAngle = 0.7f;
  for (const double angle : {0.0, 0.29, 0.35, 0.5, 0.65, 0.71}) {
    const double cosine = std::cos(angle);
    const double angular = std::clamp((cosine - std::cos(0.7)) / (std::cos(0.3) - std::cos(0.7)), 0.0, 1.0);
    const double expected = 5.0 / pi * angular * angular * std::pow(cosine, 3.0) / 4.0;
    EXPECT_NEAR(radianceOf(floorShot({2.0 * std::tan(angle), 0, 0}, {light})), expected, 1e-3) << angle;
  }
}

TEST(PunctualLight, Occluder_CastsAHardShadow) {
  Shot shot = floorShot({0, 0, 0}, {pointLight({0, 4, 0}, 7.0f)});
  CompiledScene roof = ground(1, 0.5f, 2.0f);
  append(shot.scene, roof);
  shot.scene.materials[1] = lambert(0.0f);
  EXPECT_EQ(radianceOf(shot), 0.0);
}

// A wall that hides half of the disk of a light: whatever the light's size, half of it arrives at the edge of
// the hard shadow.
TEST(PunctualLight, OfASize_ShinesByTheShareThatIsSeen) {
  Light sun;
  sun.type = LightType::Directional;
  sun.direction = {0, -1, 0};
  sun.intensity = glm::vec3(3.0f);
  for (const float radius : {0.1f, 0.6f}) {
    for (const bool walled : {false, true}) {
      for (Light light : {sun, pointLight({0, 4, 0}, 48.0f)}) {
        light.radius = light.type == LightType::Directional ? radius : 4.0f * std::sin(radius);
        Shot shot = floorShot({0, 0, 0}, {light});
        if (walled)
          append(shot.scene, sceneOf({{0, 2, -9}, {9, 2, -9}, {9, 2, 9}, {0, 2, 9}}, {{0, 1, 2}, {0, 2, 3}}));
        if (walled) shot.scene.materials[1] = lambert(0.0f);
        shot.request.samples = 4096;
        EXPECT_NEAR(radianceOf(shot), (walled ? 0.5 : 1.0) * 3.0 / pi, 0.02) << radius << ' ' << walled;
      }
    }
  }
}

/// A square lamp of edge 2 `half` at height 1 facing down, and a floor around the origin.
Shot lampShot(float half, const CompiledMaterial& lamp) {
  Shot shot = floorShot({0, 0, 0}, {});
  append(shot.scene, sceneOf({{-half, 1, -half}, {half, 1, -half}, {half, 1, half}, {-half, 1, half}},
                             {{0, 1, 2}, {0, 2, 3}}));
  shot.scene.materials[1] = lamp;
  shot.camera = orthographicCamera({0, 0.5, 0}, {0, 0, 0}, 1e-3);
  shot.request.samples = 1024;
  return shot;
}

/// Form factor at a point under the middle of a parallel square of half edge `a` at distance 1.
double squareFormFactor(double a) {
  const double root = std::sqrt(1.0 + a * a);
  return 4.0 / pi * (a / root) * std::atan(a / root);
}

TEST(Emitter, SquareLamp_LightsByItsFormFactor) {
  for (const float half : {0.2f, 1.0f})
    for (const Integrator integrator : integrators) {
      Shot shot = lampShot(half, emitter(glm::vec3(3.0f)));
      shot.request.integrator = integrator;
      const MeanAndError found = meanOf(shot.render());
      const double expected = 3.0 * squareFormFactor(half);
      EXPECT_NEAR(found.mean, expected, 4.0 * found.error + 1e-5);
      EXPECT_LT(found.error, 1e-2 * expected);
    }
}

TEST(Emitter, Back_NeitherShinesNorLightsUnlessDoubleSided) {
  for (const bool doubleSided : {false, true}) {
    CompiledMaterial lamp = emitter(glm::vec3(3.0f));
    lamp.doubleSided = doubleSided;
    Shot shot = lampShot(0.5f, lamp);
    // Seen from above: the eye looks through the lamp's back unless the lamp is double-sided.
    shot.camera = orthographicCamera({0, 3, 0}, {0, 1, 0}, 0.1);
    shot.camera.zFar = 2.5;  // In front of the floor.
    EXPECT_NEAR(radianceOf(shot), doubleSided ? 3.0 : 0.0, 1e-5);
    shot.camera.zFar = 0.0;
    // The floor is moved above the lamp, lit by the lamp's back, and seen from below.
    shot.scene.materials[0].doubleSided = true;
    shot.scene.positions[0].y = shot.scene.positions[1].y = shot.scene.positions[2].y =
        shot.scene.positions[3].y = 2.0f;
    shot.camera = orthographicCamera({0, 1.5, 0}, {0, 2, 0}, 1e-3);
    for (const Estimator estimator : {Estimator::Both, Estimator::LightsOnly, Estimator::ScatterOnly}) {
      shot.request.estimator = estimator;
      const MeanAndError found = meanOf(shot.render());
      EXPECT_NEAR(found.mean, doubleSided ? 3.0 * squareFormFactor(0.5) : 0.0, 4.0 * found.error + 1e-5);
    }
  }
}

/// A room with a lamp, a box of rough metal, a diffuse box, and a sky that shines through the open front.
Shot mixedRoom() {
  Shot shot =
      shotOf(box(1, {-1, 0, -1}, {1, 2, 1}, true), cameraAt({0, 1, 0.95}, {0, 0.9, -1}, 1.3), 9, 1024);
  shot.scene.triangles.erase(shot.scene.triangles.begin() + 8, shot.scene.triangles.begin() + 10);
  shot.scene.triangleMaterials.resize(shot.scene.triangles.size());
  shot.scene.triangleFlat.assign(shot.scene.triangles.size(), 1);
  append(shot.scene, box(1, {-0.7f, 0.01f, -0.7f}, {-0.1f, 0.8f, -0.1f}, false));
  append(shot.scene, sphere(10, 0.3f, {0.4f, 0.4f, -0.3f}));
  append(shot.scene,
         sceneOf({{-0.3f, 1.9f, -0.3f}, {0.3f, 1.9f, -0.3f}, {0.3f, 1.9f, 0.3f}, {-0.3f, 1.9f, 0.3f}},
                 {{0, 1, 2}, {0, 2, 3}}));
  shot.scene.materials = {lambert(0.6f), metal(0.9f, 0.5f), lambert(0.4f), emitter({5.0f, 4.0f, 3.0f})};
  shot.scene.materials[2].specular = 1.0f;
  shot.scene.materials[2].roughness = 0.4f;
  shot.sky = Environment{
      4,
      2,
      {{0.1f, 0, 0}, {0, 2, 0}, {0, 0, 1}, {1, 1, 1}, {0, 0, 0}, {0.5f, 0.5f, 0}, {0, 3, 0}, {1, 0, 1}}};
  shot.request.depth = 5;
  return shot;
}

/// Expects that means of blocks of 3 x 3 pixels differ by only a few standard errors of their difference.
void expectSamePicture(const Film& a, const Film& b) {
  const std::vector<float> va = a.variance(), vb = b.variance();
  constexpr int block = 3;
  double chiSquare = 0.0;
  int blocks = 0;
  for (int y = 0; y + block <= a.height; y += block)
    for (int x = 0; x + block <= a.width; x += block) {
      double difference = 0.0, variance = 0.0;
      for (int j = 0; j < block; ++j)
        for (int i = 0; i < block; ++i) {
          const auto pixel = static_cast<std::size_t>((y + j) * a.width + x + i);
          difference += a.means[pixel] - b.means[pixel];
          variance += static_cast<double>(va[pixel]) + static_cast<double>(vb[pixel]);
        }
      EXPECT_LT(std::abs(difference), 5.0 * std::sqrt(variance)) << "block " << x << ' ' << y;
      chiSquare += difference * difference / variance;
      ++blocks;
    }
  EXPECT_LT(chiSquare, blocks + 4.0 * std::sqrt(2.0 * blocks));
}

TEST(Estimators, LightsAloneScatteringAloneAndBoth_Agree) {
  Shot shot = mixedRoom();
  const Film both = shot.render();
  shot.request.samples = 4096;
  shot.request.seed = 1;
  shot.request.estimator = Estimator::LightsOnly;
  expectSamePicture(both, shot.render());
  shot.request.estimator = Estimator::ScatterOnly;
  expectSamePicture(both, shot.render());
}

TEST(Integrators, WithoutSpecularSurfaces_AreThePathTracersShallowDepths) {
  Shot shot = mixedRoom();
  shot.scene.materials[1] = shot.scene.materials[2] = lambert(0.5f);
  const auto withDepth = [&](Integrator integrator, int depth, std::uint64_t seed) {
    shot.request.integrator = integrator;
    shot.request.depth = depth;
    shot.request.seed = seed;
    return shot.render();
  };
  expectSamePicture(withDepth(Integrator::Whitted, 9, 1), withDepth(Integrator::Path, 2, 2));
  expectSamePicture(withDepth(Integrator::Distributed, 9, 3), withDepth(Integrator::Path, 3, 4));
}

// Shadow rays from near the edge between the floor's two triangles at height zero start in the plane of both.
TEST(Whitted, EdgeOfAFloorAtHeightZero_LosesNoLight) {
  Shot shot = floorShot({0, 0, 0}, {pointLight({0, 2, 0}, 7.0f)});
  shot.request.samples = shot.request.samplesPerPass = 8192;
  shot.request.integrator = Integrator::Whitted;
  for (const glm::vec3& pixel : shot.render().picture().pixels) EXPECT_NEAR(pixel.r, 7.0 / (4.0 * pi), 2e-6);
}

TEST(Whitted, Mirror_ShowsWhatItReflects) {
  Shot shot = floorShot({0, 0, 0}, {pointLight({0, 2, 0}, 7.0f)});
  const double direct = radianceOf(shot);
  // A mirror at 45 degrees above the floor, looked at from the side.
  append(shot.scene,
         sceneOf({{-1, 0.5, 0.5}, {1, 0.5, 0.5}, {1, 1.5, -0.5}, {-1, 1.5, -0.5}}, {{0, 2, 1}, {0, 3, 2}}));
  shot.lights = {pointLight({0, 0.5, 0}, 7.0f)};
  shot.scene.materials[1] = metal(0.5f, 0.0f);
  shot.camera = orthographicCamera({0, 1, -3}, {0, 1, 0}, 1e-3);
  shot.request.depth = 3;
  shot.request.integrator = Integrator::Whitted;
  const double reflectance = 0.5 + 0.5 * std::pow(1.0 - std::sqrt(0.5), 5.0);
  EXPECT_NEAR(radianceOf(shot), reflectance * 16.0 * direct, 1e-3 * direct);
}

TEST(Sky, EveryTexel_IsSeenInItsDirection) {
  Environment sky{8, 4, {}};
  for (int i = 0; i < 32; ++i) sky.radiance.push_back({1.0f + static_cast<float>(i), 0.5f, 2.0f});
  for (int row = 0; row < 4; ++row)
    for (int column = 0; column < 8; ++column) {
      const glm::dvec3 d = Environment::direction((column + 0.5) / 8.0, (row + 0.5) / 4.0);
      Shot shot = shotOf(ground(1, 0.01f, -100.0f), cameraAt({0, 0, 0}, d, 1e-4), 1, 4);
      shot.sky = sky;
      EXPECT_NEAR(shot.render().picture().pixels[0].r, 1.0f + static_cast<float>(8 * row + column), 1e-3);
    }
}

// The centre column looks along -Z and u grows towards +X: a bright right half lights surfaces that face +X.
TEST(Sky, BrightHalf_LightsTheSideThatFacesIt) {
  Environment sky{64, 32, {}};
  for (int y = 0; y < 32; ++y)
    for (int x = 0; x < 64; ++x) sky.radiance.push_back(glm::vec3(x >= 32 ? 1.0f : 0.0f));
  for (const double side : {1.0, -1.0})
    for (const Estimator estimator : {Estimator::Both, Estimator::LightsOnly, Estimator::ScatterOnly}) {
      Shot shot = shotOf(box(1, {-1, -1, -1}, {1, 1, 1}, false),
                         orthographicCamera({3 * side, 0, 0}, {0, 0, 0}, 0.5), 4, 1024);
      shot.scene.triangleFlat.assign(shot.scene.triangles.size(), 1);
      shot.scene.materials[0] = lambert(1.0f);
      shot.sky = sky;
      shot.request.estimator = estimator;
      const MeanAndError found = meanOf(shot.render());
      // Half a texel's width beside either half is interpolated between the two; it is seen at grazing
      // angles.
      EXPECT_NEAR(found.mean, side > 0 ? 1.0 : 0.0, 4.0 * found.error + 2e-3);
    }
}

TEST(Intervals, Bounds_FollowWeightsAndLeaveNothingOut) {
  const std::vector<double> weights{1.0, 0.0, 3.0, 1e-30, 4.0, 0.0};
  const auto bounds = makeIntervals(weights);
  double sum = 0.0;
  for (std::size_t i = 0; i < weights.size(); ++i) {
    const double probability = intervalProbability(bounds, i);
    EXPECT_GT(probability, 0.0);
    EXPECT_NEAR(probability, weights[i] / 8.0, 1e-8);
    sum += probability;
  }
  EXPECT_DOUBLE_EQ(sum, 1.0);
  EXPECT_EQ(makeIntervals(std::vector<double>{5.0}), std::vector<std::uint32_t>{0u});
  const auto dark = makeIntervals(std::vector<double>{0.0, 0.0});
  EXPECT_NEAR(intervalProbability(dark, 0), 0.5, 1e-8);
}

TEST(LightTables, BlackLights_AreLeftOut) {
  CompiledScene scene = ground(1, 1.0f);
  const Environment black = constantEnvironment(glm::vec3(0.0f));
  const auto tables = makeLightTables(scene, {pointLight({0, 1, 0}, 0.0f)}, &black, true);
  EXPECT_EQ(tables.groupCount, 0u);
  EXPECT_TRUE(tables.punctual.empty());
  EXPECT_TRUE(tables.emitters.empty());
  EXPECT_TRUE(tables.sky.empty());
}

/// Direct light and light of longer paths are rendered separately, and must add up.
TEST(LeastDepth, DirectLightAndTheRest_AreTogetherAllLight) {
  CompiledScene scene = ground(1, 10.0f);
  scene.materials[0] = lambert(0.7f);
  append(scene, sphere(24, 0.5f, {0, 0.5f, 0}));
  scene.materials[1] = lambert(0.9f);
  Shot shot = shotOf(std::move(scene), orthographicCamera({0, 3, 0.9}, {0, 0, 0.8}, 0.6), 8, 1024);
  shot.lights = {pointLight({2, 2, 1}, 6.0f), pointLight({-1, 3, 2}, 8.0f)};
  shot.sky = constantEnvironment(glm::vec3(0.2f));
  shot.request.depth = 8;
  const MeanAndError all = meanOf(shot.render());
  shot.request.leastDepth = 3;
  const MeanAndError rest = meanOf(shot.render());
  shot.request.leastDepth = 1;
  shot.request.depth = 2;
  const MeanAndError direct = meanOf(shot.render());
  ASSERT_LT(all.error, 0.005 * all.mean);
  EXPECT_GT(rest.mean, 0.02 * all.mean);
  EXPECT_NEAR(direct.mean + rest.mean, all.mean, 4.0 * std::hypot(all.error, direct.error, rest.error));
}

}  // namespace
}  // namespace prelight::test
