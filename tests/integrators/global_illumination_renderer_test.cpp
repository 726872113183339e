#include "integrators/global_illumination_renderer.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <utility>

#include "integrators/cornell_by_mitsuba.h"
#include "scene/builtin/builtin.h"
#include "scene/gltf/load/loader.h"
#include "support/devices.h"
#include "support/materials.h"
#include "support/scenes.h"
#include "support/shot.h"

namespace prelight::test {
namespace {

struct IlluminatedShot {
  Scene source;
  CompiledScene scene;
  std::vector<Light> lights;
  std::optional<Environment> sky;
  Camera camera;
  GlobalIlluminationPictureRequest request;
  GlobalIlluminationPictureReport report;

  Picture render() {
    const LitScene lit{scene, noImages(), lights, sky ? &*sky : nullptr};
    Progress progress;
    report = {};
    return renderGlobalIllumination(source, lit, camera, request, sharedDevice(), progress, report);
  }
};

IlluminatedShot builtinShot(const std::string& name, int size) {
  IlluminatedShot shot;
  Warnings warnings;
  shot.source = loadScene(makeBuiltinScene(name), warnings);
  shot.scene = compileScene(shot.source, warnings);
  shot.lights = shot.source.lights;
  shot.camera = shot.source.cameras.at(0);
  shot.request.width = shot.request.height = size;
  return shot;
}

bool runs(const GlobalIlluminationPictureReport& report, Pass pass) {
  for (const PlannedPass& p : report.plan)
    if (p.name == pass.name) return p.runs;
  ADD_FAILURE() << pass.name;
  return false;
}

Picture truthOf(const IlluminatedShot& shot, std::uint64_t samples) {
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

/// All blocks and all colours are compared.
TEST(GlobalIlluminationRenderer, Cornell_IsWhatMitsubaDraws) {
  IlluminatedShot shot = builtinShot("cornell", cornellPixels);
  shot.request.samples = 64;
  const Picture picture = shot.render();
  constexpr int side = cornellPixels / cornellBlocks;
  glm::dvec3 sum(0.0), expectedSum(0.0);
  for (int block = 0; block < cornellBlocks * cornellBlocks; ++block) {
    const int x = block % cornellBlocks * side, y = block / cornellBlocks * side;
    glm::dvec3 found(0.0);
    for (int i = 0; i < side * side; ++i)
      found += glm::dvec3(
                   picture.pixels[static_cast<std::size_t>(cornellPixels * (y + i / side) + x + i % side)]) /
               double(side * side);
    const glm::dvec3 expected(cornellByMitsuba[static_cast<std::size_t>(block)]);
    for (int c = 0; c < 3; ++c)
      EXPECT_NEAR(found[c], expected[c], 0.03 * expected[c] + 1e-3) << block << ' ' << c;
    sum += found;
    expectedSum += expected;
  }
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(sum[c], expectedSum[c], 0.005 * expectedSum[c]) << c;
  EXPECT_FALSE(runs(shot.report, Pass::CausticPhotons));
  EXPECT_FALSE(runs(shot.report, Pass::RaysToLargeEmitters));
  EXPECT_FALSE(runs(shot.report, Pass::BacksOfOneSidedSurfaces));
  EXPECT_EQ(shot.report.causticPhotons.rays, 0u);
}

/// A closed room of albedo 1/2 whose walls emit 1 shows 2 everywhere.
TEST(GlobalIlluminationRenderer, FurnaceRoom_ShowsItsGeometricSeries) {
  // With one cell, light of emitters on the texels that are gathered from is integrated; with two there are
  // too many emitters for that.
  for (const int cells : {1, 2}) {
    IlluminatedShot shot;
    shot.scene = box(cells, glm::vec3(-1.0f), glm::vec3(1.0f), true);
    shot.scene.materials[0] = lambert(0.5f);
    shot.scene.materials[0].emission = glm::vec3(1.0f);
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
    EXPECT_TRUE(runs(shot.report, Pass::RaysToLargeEmitters));
  }
}

/// A room of albedo 1/2 whose walls emit 1 shows 2 everywhere, even around a box that absorbs nothing and
/// transmits most of the light.
TEST(GlobalIlluminationRenderer, FurnaceRoomWithATranslucentBox_ShowsTheSame) {
  IlluminatedShot shot;
  shot.scene = box(1, glm::vec3(-1.0f), glm::vec3(1.0f), true);
  append(shot.scene, box(2, {-0.7f, -0.7f, -0.7f}, {0.3f, 0.3f, 0.3f}, false));
  shot.scene.triangleFlat.assign(shot.scene.triangles.size(), 1);
  shot.scene.materials[0] = lambert(0.5f);
  shot.scene.materials[0].emission = glm::vec3(1.0f);
  shot.scene.materials[1] = translucent(1.0f, 0.7f, 1.0f);
  shot.camera = cameraAt({0.8, 0.7, 0.8}, {-0.2, -0.2, -0.3}, 0.5);
  shot.request.width = shot.request.height = 8;
  shot.request.samples = 64;
  double sum = 0.0;
  for (const glm::vec3& pixel : shot.render().pixels) sum += static_cast<double>(pixel.y) / 64.0;
  EXPECT_NEAR(sum, 2.0, 0.02 * 2.0);
}

/// The share of a point's cosine-weighted hemisphere that a square covers, one metre above it.
double coveredBySquare(double half) {
  const double root = std::sqrt(1.0 + half * half);
  return 4.0 / std::numbers::pi * (half / root) * std::atan(half / root);
}

/// A roof hides the sun from a floor that the sky lights from the sides. The sun must bring no noise there:
/// each kind of light has its share of the samples.
TEST(GlobalIlluminationRenderer, BelowARoof_TheHiddenSunBringsNoNoise) {
  const float half = 1.5f;
  IlluminatedShot shot;
  shot.scene = ground(1, 10.0f);
  shot.scene.materials[0] = lambert(1.0f);
  append(shot.scene, sceneOf({{-half, 1, -half}, {half, 1, -half}, {half, 1, half}, {-half, 1, half}},
                             {{0, 1, 2}, {0, 2, 3}}));
  shot.scene.materials[1] = lambert(0.0f);
  Light sun;
  sun.type = LightType::Directional;
  sun.direction = {0, -1, 0};
  sun.intensity = glm::vec3(300.0f);
  shot.lights = {sun};
  shot.sky = constantEnvironment(glm::vec3(1.0f));
  shot.camera = orthographicCamera({0, 0.5, 0}, {0, 0, 0}, 1e-3);
  shot.request.width = shot.request.height = 16;
  shot.request.samples = 32;
  shot.request.parts = true;
  shot.request.guides = true;  // without specks being spread
  shot.render();
  const double expected = 1.0 - coveredBySquare(half);
  double sum = 0.0, squares = 0.0;
  for (const PartPicture& part : shot.report.parts) {
    if (part.part != PicturePart::Direct) continue;
    for (const glm::vec3& pixel : part.pixels) {
      sum += double(pixel.y);
      squares += std::pow(double(pixel.y) - expected, 2.0);
    }
  }
  EXPECT_NEAR(sum / 256.0, expected, 0.1 * expected);
  EXPECT_LT(std::sqrt(squares / 256.0), expected);
}

/// A leaf of 4 x 4 m in the sun, 1 m above a floor, transmits 0.8 of the light. The floor under its middle
/// receives the leaf's form factor of that. The leaf is also seen from below.
TEST(GlobalIlluminationRenderer, LeafInTheSun_LightsTheFloorAndTheEye) {
  IlluminatedShot shot;
  shot.scene = ground(4, 6.0f);
  append(shot.scene, ground(2, 2.0f, 1.0f));
  shot.scene.materials[0] = lambert(0.5f);
  shot.scene.materials[1] = translucent(0.9f, 1.0f, 0.8f);
  shot.scene.materials[1].doubleSided = true;  // Its back is seen.
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
  // From above, only light from the floor comes through.
  EXPECT_LT(meanFrom({0, 2, 0}, {0, 1, 0}), 0.8 * 0.5 * leaf);
}

/// A floor beside a very rough ball of glass, lit by a small lamp. Photons bring the light that passes
/// through the ball; rays from the texels would rarely find the lamp behind it.
TEST(GlobalIlluminationRenderer, FloorBesideARoughBallOfGlass_IsSmooth) {
  IlluminatedShot shot;
  shot.scene = ground(2, 3.0f);
  append(shot.scene, sphere(16, 0.5f, {0.0f, 0.51f, 0.0f}));
  append(shot.scene,
         sceneOf({{0.8f, 2.0f, -0.2f}, {1.2f, 2.0f, -0.2f}, {1.2f, 2.0f, 0.2f}, {0.8f, 2.0f, 0.2f}},
                 {{0, 1, 2}, {0, 2, 3}}));
  shot.scene.materials[0] = lambert(0.7f);
  shot.scene.materials[1] = glass(1.5f, true);
  shot.scene.materials[1].roughness = 1.0f;
  shot.scene.materials[2] = lambert(0.0f);
  shot.scene.materials[2].emission = glm::vec3(40.0f);
  shot.camera = cameraAt({-0.6, 1.4, 1.6}, {-0.55, 0.0, 0.1}, 0.25);
  shot.request.width = shot.request.height = 16;
  shot.request.samples = 16;
  const Picture picture = shot.render(), truth = truthOf(shot, 8192);
  EXPECT_TRUE(runs(shot.report, Pass::CausticPhotons));
  double error = 0.0;
  constexpr std::size_t side = 4;  // Pixels per block.
  for (std::size_t block = 0; block < 16; ++block) {
    double found = 0.0, expected = 0.0;
    for (std::size_t i = 0; i < side * side; ++i) {
      const std::size_t pixel = (block / 4 * side + i / side) * 16 + block % 4 * side + i % side;
      found += double(picture.pixels[pixel].y);
      expected += double(truth.pixels[pixel].y);
    }
    error += std::pow(found / expected - 1.0, 2.0) / 16.0;
  }
  EXPECT_LT(error, 0.1);                  // Without these photons it is 0.5.
  shot.scene.materials[1].solid = false;  // A sheet blurs what is behind it, but rays are enough for that.
  shot.render();
  EXPECT_FALSE(runs(shot.report, Pass::CausticPhotons));
}

/// A white floor of albedo 1/2 under an even sky of 1 and a lamp of 3 W/sr 1 m above the visible part: 0.5
/// comes from the sky and 0.5 / pi * 3 from the lamp. A single sample of the sky would differ by 1.29 of its
/// mean; independent samples would differ by 0.46 with eight per pixel, and by 0.23 with four times as many.
TEST(GlobalIlluminationRenderer, OpenFloorUnderTheSky_IsExactInTheMeanAndSmooth) {
  IlluminatedShot shot;
  shot.scene = ground(1, 40.0f);
  shot.scene.materials[0] = lambert(0.5f);
  shot.sky = constantEnvironment(glm::vec3(1.0f));
  shot.camera = cameraAt({0.0, 0.9, 0.0}, {0.0, 0.0, 0.01}, 0.02);
  shot.request.width = shot.request.height = 32;
  shot.request.samples = 8;
  double sum = 0.0, squares = 0.0;
  for (const glm::vec3& pixel : shot.render().pixels) {
    sum += double(pixel.y) / 1024.0;
    squares += std::pow(double(pixel.y) / 0.5 - 1.0, 2.0) / 1024.0;
  }
  EXPECT_NEAR(sum, 0.5, 0.005);
  EXPECT_LT(std::sqrt(squares), 0.08);

  Light lamp;
  lamp.type = LightType::Point;
  lamp.position = {0.0, 1.0, 0.0};
  lamp.intensity = glm::vec3(3.0f);
  shot.lights = shot.scene.lights = {lamp};
  sum = 0.0;
  for (const glm::vec3& pixel : shot.render().pixels) sum += double(pixel.y) / 1024.0;
  EXPECT_NEAR(sum, 0.5 + 1.5 / std::numbers::pi, 0.01);
}

/// A spot shines down on a flat mirror of reflectance 0.8 only; the floor above it sees the lamp's image.
IlluminatedShot mirroredSpot() {
  IlluminatedShot shot;
  shot.scene = ground(1, 1.0f);
  shot.scene.materials[0] = metal(0.8f, 0.0f);
  CompiledScene ceiling = ground(1, 3.0f, 2.0f);
  for (glm::uvec3& t : ceiling.triangles) std::swap(t.y, t.z);
  append(shot.scene, ceiling);
  shot.scene.triangleFlat.assign(shot.scene.triangles.size(), 1);
  shot.scene.materials[1] = lambert(0.01f);  // It sends almost nothing back to the mirror.
  Light spot;
  spot.type = LightType::Spot;
  spot.position = {0.0, 1.0, 0.0};
  spot.direction = {0.0, -1.0, 0.0};
  spot.innerConeAngle = 0.7f;
  spot.outerConeAngle = 0.75f;
  spot.intensity = glm::vec3(10.0f);
  shot.lights = {spot};
  // The camera is just under the ceiling. The lamp casts no shadow, and neither does the camera.
  shot.camera = orthographicCamera({0.0, 1.99, 0.0}, {0.0, 2.0, 0.0}, 1.0);
  shot.request.width = shot.request.height = 32;
  return shot;
}

/// The caustic of the mirror is the light of the lamp's image: 0.8 I cos / d2, 3 m below the ceiling.
TEST(GlobalIlluminationRenderer, CausticOfAFlatMirror_IsTheLightOfTheLampsImage) {
  IlluminatedShot shot = mirroredSpot();
  shot.request.causticPhotons = 1'000'000;
  const Picture picture = shot.render();
  ASSERT_TRUE(runs(shot.report, Pass::CausticPhotons));
  double sum = 0.0, expectedSum = 0.0;
  for (int y = 0; y < 32; y += 8)
    for (int x = 0; x < 32; x += 8) {
      double found = 0.0, expected = 0.0;
      for (int i = 0; i < 64; ++i) {
        const int px = x + i % 8, py = y + i / 8;
        const double u = (px + 0.5) / 16.0 - 1.0, v = (py + 0.5) / 16.0 - 1.0, squared = u * u + v * v + 9.0;
        expected += 0.01 / std::numbers::pi * 0.8 * 10.0 * 3.0 / (squared * std::sqrt(squared));
        found += static_cast<double>(picture.pixels[static_cast<std::size_t>(32 * py + px)].y);
      }
      EXPECT_NEAR(found, expected, 0.05 * expected) << x << ' ' << y;
      sum += found;
      expectedSum += expected;
    }
  EXPECT_NEAR(sum, expectedSum, 0.01 * expectedSum);
}

/// A floor and a one-sided sheet above it whose back faces the floor. A spot under the sheet shines on the
/// floor alone: all light on the sheet was reflected by the floor.
IlluminatedShot underASheet() {
  IlluminatedShot shot;
  shot.scene = ground(1, 1.5f);
  append(shot.scene, ground(1, 1.5f, 1.0f));
  shot.scene.triangleFlat.assign(shot.scene.triangles.size(), 1);
  shot.scene.materials[0] = shot.scene.materials[1] = lambert(0.7f);
  Light spot;
  spot.type = LightType::Spot;
  spot.position = {0.0, 0.95, 0.0};
  spot.direction = {0.0, -1.0, 0.0};
  spot.innerConeAngle = 0.5f;
  spot.outerConeAngle = 0.6f;
  spot.intensity = glm::vec3(5.0f);
  shot.lights = {spot};
  shot.request.width = shot.request.height = 24;
  shot.request.samples = 16;
  return shot;
}

/// Means of 3 x 3 blocks.
std::vector<double> blockMeans(const Picture& picture) {
  std::vector<double> means(9, 0.0);
  for (int y = 0; y < 24; ++y)
    for (int x = 0; x < 24; ++x)
      means[static_cast<std::size_t>(y / 8 * 3 + x / 8)] +=
          static_cast<double>(picture.pixels[static_cast<std::size_t>(24 * y + x)].y) / 64.0;
  return means;
}

TEST(GlobalIlluminationRenderer, FloorBeyondTheSpot_GetsWhatTheSheetsBackReflects) {
  IlluminatedShot shot = underASheet();
  shot.camera = orthographicCamera({1.05, 0.01, 0.0}, {1.05, 0.0, 0.0}, 0.35);
  const std::vector<double> found = blockMeans(shot.render()), truth = blockMeans(truthOf(shot, 4096));
  EXPECT_TRUE(runs(shot.report, Pass::BacksOfOneSidedSurfaces));
  for (std::size_t i = 0; i < 9; ++i) EXPECT_NEAR(found[i], truth[i], 0.05 * truth[i]) << i;
}

TEST(GlobalIlluminationRenderer, TexelsOfAPictureWithGuides_HaveRaysByItsSamples) {
  GlobalIlluminationPictureRequest request;
  request.samples = 64;
  EXPECT_EQ(request.raysOfTexels(false), 128u) << "without guides";
  request.guides = true;
  for (const auto& [samples, rays] :
       {std::pair{1u, 128u}, {4u, 128u}, {7u, 128u}, {8u, 256u}, {16u, 512u}, {64u, 1024u}}) {
    request.samples = samples;
    EXPECT_EQ(request.raysOfTexels(false), rays) << samples;
  }
  EXPECT_EQ(request.raysOfTexels(true), 128u) << "under a sky";
  request.gatherRays = 64;
  EXPECT_EQ(request.raysOfTexels(false), 64u) << "asked for";
}

TEST(GlobalIlluminationRenderer, SceneWithoutLight_IsBlack) {
  IlluminatedShot shot = builtinShot("cornell", 8);
  for (CompiledMaterial& m : shot.scene.materials) m.emission = glm::vec3(0.0f);
  for (const glm::vec3& pixel : shot.render().pixels) EXPECT_EQ(pixel, glm::vec3(0.0f));
  EXPECT_FALSE(runs(shot.report, Pass::IndirectLight));
  EXPECT_EQ(shot.report.photons.emitted, 0u);
}

TEST(GlobalIlluminationRenderer, SameSeed_GivesTheSamePicture_AnotherSeedAnother) {
  IlluminatedShot shot = builtinShot("caustics", 16);
  shot.request.causticPhotons = 20000;
  const Picture a = shot.render(), b = shot.render();
  EXPECT_EQ(a.pixels, b.pixels);
  EXPECT_TRUE(runs(shot.report, Pass::CausticPhotons));
  shot.request.seed = shot.request.indirect.seed = 1;
  EXPECT_NE(a.pixels, shot.render().pixels);
}

}  // namespace
}  // namespace prelight::test
