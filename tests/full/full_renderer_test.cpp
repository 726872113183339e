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
