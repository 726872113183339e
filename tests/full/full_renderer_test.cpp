#include "full/full_renderer.h"

#include <gtest/gtest.h>

#include <cmath>

#include "reference/shot.h"
#include "scene/builtin.h"
#include "scene/loader.h"
#include "support/devices.h"

namespace prelight::test {
namespace {

struct FullShot {
  Scene source;
  CompiledScene scene;
  std::vector<Light> lights;
  std::optional<Environment> sky;
  Camera camera;
  FullRequest request;
  FullReport report;

  Picture render() {
    const LitScene lit{scene, noImages(), lights, sky ? &*sky : nullptr};
    Progress progress;
    report = {};
    return renderFull(source, lit, camera, request, sharedDevice(), progress, report);
  }
};

FullShot builtinShot(const std::string& name, int size) {
  FullShot shot;
  Warnings warnings;
  shot.source = loadScene(makeBuiltinScene(name), warnings);
  shot.scene = compileScene(shot.source, warnings);
  shot.lights = shot.source.lights;
  shot.camera = shot.source.cameras.at(0);
  shot.request.width = shot.request.height = size;
  return shot;
}

bool runs(const FullReport& report, const std::string& pass) {
  for (const PlannedPass& p : report.plan)
    if (p.name == pass) return p.runs;
  ADD_FAILURE() << pass;
  return false;
}

/// Mean of squared differences over squares of the truth, over the best 99 % of the pixels.
double relativeError(const Picture& picture, const Picture& truth) {
  std::vector<double> errors;
  for (std::size_t i = 0; i < truth.pixels.size(); ++i) {
    double error = 0.0;
    for (int c = 0; c < 3; ++c) {
      const double t = truth.pixels[i][c], d = static_cast<double>(picture.pixels[i][c]) - t;
      error += d * d / (t * t + 0.01) / 3.0;
    }
    errors.push_back(error);
  }
  std::sort(errors.begin(), errors.end());
  const std::size_t kept = errors.size() * 99 / 100;
  double sum = 0.0;
  for (std::size_t i = 0; i < kept; ++i) sum += errors[i];
  return sum / static_cast<double>(kept);
}

Picture truthOf(const FullShot& shot, std::uint64_t samples) {
  Shot reference;
  reference.scene = shot.scene;
  reference.lights = shot.lights;
  reference.sky = shot.sky;
  reference.camera = shot.camera;
  reference.request.width = shot.request.width;
  reference.request.height = shot.request.height;
  reference.request.samples = samples;
  return reference.render().picture();
}

TEST(FullRenderer, Cornell_ComesCloseToPathTracing) {
  FullShot shot = builtinShot("cornell", 48);
  shot.request.samples = 64;
  EXPECT_LT(relativeError(shot.render(), truthOf(shot, 2048)), 0.002);
  EXPECT_FALSE(runs(shot.report, "caustic photons"));
  EXPECT_FALSE(runs(shot.report, "rays to large emitters"));
  EXPECT_EQ(shot.report.causticPhotons.rays, 0u);
}

/// A closed room of albedo 1/2 whose walls emit 1 shows 2 everywhere.
TEST(FullRenderer, FurnaceRoom_ShowsItsGeometricSeries) {
  // Emitters whose light on the texels that are gathered from is integrated, and too many for that.
  for (const int cells : {1, 2}) {
    FullShot shot;
    shot.scene = box(cells, glm::vec3(-1.0f), glm::vec3(1.0f), true);
    shot.scene.materials[0] = lambert(0.5f);
    shot.scene.materials[0].emissionFactor = shot.scene.materials[0].emission = glm::vec3(1.0f);
    shot.camera = cameraAt({0.3, 0.2, 0.1}, {-1.0, -0.5, -1.0}, 1.2);
    shot.request.width = shot.request.height = 16;
    shot.request.samples = 64;
    double sum = 0.0, squares = 0.0, count = 0.0;
    for (const std::uint64_t seed : {0u, 1u, 2u, 3u}) {
      shot.request.seed = shot.request.indirect.seed = seed;
      for (const glm::vec3& pixel : shot.render().pixels) {
        sum += static_cast<double>(pixel.y);
        squares += std::pow(static_cast<double>(pixel.y) - 2.0, 2.0);
        count += 1.0;
      }
    }
    EXPECT_NEAR(sum / count, 2.0, 0.002 * 2.0) << cells;
    EXPECT_LT(std::sqrt(squares / count), 0.01 * 2.0) << cells;
    EXPECT_TRUE(runs(shot.report, "rays to large emitters"));
  }
}

/// A room of albedo 1/2 whose walls emit 1, in it a box that absorbs nothing and lets most of the light
/// through: 2 everywhere.
TEST(FullRenderer, FurnaceRoomWithATranslucentBox_ShowsTheSame) {
  FullShot shot;
  shot.scene = box(1, glm::vec3(-1.0f), glm::vec3(1.0f), true);
  append(shot.scene, box(2, {-0.7f, -0.7f, -0.7f}, {0.3f, 0.3f, 0.3f}, false));
  shot.scene.triangleFlat.assign(shot.scene.triangles.size(), 1);
  shot.scene.materials[0] = lambert(0.5f);
  shot.scene.materials[0].emissionFactor = shot.scene.materials[0].emission = glm::vec3(1.0f);
  shot.scene.materials[1] = translucent(1.0f, 0.7f, 1.0f);
  shot.camera = cameraAt({0.8, 0.7, 0.8}, {-0.2, -0.2, -0.3}, 0.5);
  shot.request.width = shot.request.height = 8;
  shot.request.samples = 64;
  double sum = 0.0;
  for (const glm::vec3& pixel : shot.render().pixels) sum += static_cast<double>(pixel.y) / 64.0;
  EXPECT_NEAR(sum, 2.0, 0.02 * 2.0);
}

/// The floor under the middle of a leaf of 4 x 4 m and 1 m above it, in the sun: 0.8 of the light comes
/// through, and the floor gets the leaf's form factor of that. Then the leaf itself from below.
TEST(FullRenderer, LeafInTheSun_LightsTheFloorAndTheEye) {
  FullShot shot;
  shot.scene = ground(4, 6.0f);
  append(shot.scene, ground(2, 2.0f, 1.0f));
  shot.scene.materials[0] = lambert(0.5f);
  shot.scene.materials[1] = translucent(0.9f, 1.0f, 0.8f);
  Light sun;
  sun.type = LightType::Directional;
  sun.intensity = glm::vec3(3.0f);
  sun.direction = {0, -1, 0};
  shot.lights = shot.scene.lights = {sun};
  shot.request.width = shot.request.height = 8;
  const double pi = 3.14159265358979, r = std::sqrt(5.0);
  const double factor = 4.0 / (2.0 * pi) * 2.0 * (2.0 / r) * std::atan(2.0 / r);
  const auto meanFrom = [&](const glm::dvec3& eye, const glm::dvec3& target) {
    shot.camera = cameraAt(eye, target, 0.1);
    double mean = 0.0;
    for (const glm::vec3& pixel : shot.render().pixels) mean += double(pixel.x) / 64.0;
    return mean;
  };
  const double floor = 0.5 / pi * 3.0 * 0.8 * factor, leaf = 3.0 * 0.8 / pi;
  EXPECT_NEAR(meanFrom({0, 0.9, 0}, {0, 0, 0}), floor, 0.03 * floor);
  EXPECT_NEAR(meanFrom({0, 0.1, 0}, {0, 1, 0}), leaf, 0.01 * leaf);
  // From above there is what the floor sends up through it alone.
  EXPECT_LT(meanFrom({0, 2, 0}, {0, 1, 0}), 0.8 * 0.5 * leaf);
}

TEST(FullRenderer, SceneWithoutLight_IsBlack) {
  FullShot shot = builtinShot("cornell", 8);
  for (CompiledMaterial& m : shot.scene.materials) m.emission = m.emissionFactor = glm::vec3(0.0f);
  for (const glm::vec3& pixel : shot.render().pixels) EXPECT_EQ(pixel, glm::vec3(0.0f));
  EXPECT_FALSE(runs(shot.report, "indirect light"));
  EXPECT_EQ(shot.report.photons.emitted, 0u);
}

TEST(FullRenderer, SameSeed_GivesTheSamePicture) {
  FullShot shot = builtinShot("caustics", 16);
  shot.request.causticPhotons = 20000;
  const Picture a = shot.render(), b = shot.render();
  EXPECT_EQ(a.pixels, b.pixels);
  EXPECT_TRUE(runs(shot.report, "caustic photons"));
}

}  // namespace
}  // namespace prelight::test
