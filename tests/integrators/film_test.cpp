#include <gtest/gtest.h>

#include <cmath>

#include "base/state_log.h"
#include "integrators/exposure.h"
#include "integrators/reference.h"
#include "prelight/error.h"
#include "scene/builtin/builtin.h"
#include "scene/gltf/load/loader.h"
#include "scene/pose.h"
#include "support/devices.h"
#include "support/gltf_files.h"
#include "support/resumed.h"
#include "support/shot.h"

namespace prelight::test {
namespace {

using reference::Film;

/// A lit corner with a mirror ball, which has every kind of noise.
Shot cornerShot() {
  Shot shot =
      shotOf(box(1, {-1, 0, -1}, {1, 2, 1}, true), cameraAt({0.5, 1, 0.9}, {-0.3, 0.5, -1}, 1.0), 10, 96);
  append(shot.scene, sphere(8, 0.3f, {-0.2f, 0.4f, -0.3f}));
  append(shot.scene,
         sceneOf({{-0.3f, 1.9f, -0.3f}, {0.3f, 1.9f, -0.3f}, {0.3f, 1.9f, 0.3f}, {-0.3f, 1.9f, 0.3f}},
                 {{0, 1, 2}, {0, 2, 3}}));
  shot.scene.materials = {lambert(0.6f), metal(0.9f, 0.0f), emitter(glm::vec3(5.0f))};
  return shot;
}

bool same(const Film& a, const Film& b) {
  return a.passes == b.passes && a.blockPixels == b.blockPixels && a.sums == b.sums && a.means == b.means &&
         a.squares == b.squares && a.blurs == b.blurs && a.blurSquares == b.blurSquares && a.parts == b.parts;
}

TEST(Film, MeansAndVariance_AreThoseOfThePasses) {
  Film film(2, 1);
  const std::vector<float> values{1.0f, 4.0f, 2.0f, 9.0f};
  for (const float v : values)
    film.add(std::vector<glm::vec4>{glm::vec4(glm::vec3(v), 0.0f), glm::vec4(glm::vec3(2.0f), 0.0f)});
  EXPECT_EQ(film.passes, 4u);
  EXPECT_FLOAT_EQ(film.picture().pixels[0].g, 4.0f);
  // The squared deviations 9, 0, 4, 25 sum to 38, over n (n - 1) = 12.
  EXPECT_FLOAT_EQ(film.variance()[0], 38.0f / 12.0f);
  EXPECT_NEAR(film.variance()[1], 0.0, 1e-12);
  EXPECT_NEAR(film.relativeError(), std::sqrt(38.0 / 24.0) / 3.0, 1e-6);
}

TEST(Film, ManyPasses_LoseNothing) {
  Film film(1, 1);
  for (int i = 0; i < 200000; ++i) film.add(std::vector<glm::vec4>{glm::vec4(i % 2 == 0 ? 1e6f : 1e-2f)});
  EXPECT_NEAR(film.picture().pixels[0].r, 500000.005, 0.05);
  EXPECT_NEAR(film.variance()[0], 0.25e12 / 199999.0, 1.0);
}

TEST(Film, BeforeTheSecondPass_HasNoVariance) {
  Film film(1, 1);
  EXPECT_TRUE(std::isinf(film.relativeError()));
  film.add(std::vector<glm::vec4>{glm::vec4(1.0f)});
  EXPECT_TRUE(film.variance().empty());
}

TEST(Reference, SamplesPerPass_DividesTheSamples) {
  reference::ReferenceRequest request;
  for (const std::uint64_t samples : {1u, 2u, 31u, 32u, 64u, 97u, 100u, 256u, 1000u, 4096u, 100000u}) {
    request.samples = samples;
    const std::uint32_t perPass = reference::samplesPerPass(request);
    EXPECT_EQ(samples % perPass, 0u) << samples;
    EXPECT_TRUE(perPass == 1 || samples / perPass >= 8) << samples;
  }
}

TEST(Reference, SameSeed_GivesTheSameBits_AnotherSeedDoesNot) {
  Shot shot = cornerShot();
  const Film first = shot.render();
  EXPECT_TRUE(same(first, shot.render()));
  shot.request.seed = 1;
  EXPECT_FALSE(same(first, shot.render()));
  shot.request.seed = std::uint64_t{1} << 40;
  EXPECT_FALSE(same(first, shot.render()));
}

// The variance that a picture reports is compared with the scatter of many pictures.
TEST(Reference, StatedVariance_IsTheScatterOverSeeds) {
  Shot shot = cornerShot();
  shot.request.width = shot.request.height = 4;
  constexpr int pictures = 48;
  std::vector<double> mean(16, 0.0), square(16, 0.0), stated(16, 0.0);
  for (int seed = 0; seed < pictures; ++seed) {
    shot.request.seed = static_cast<std::uint64_t>(seed);
    const Film film = shot.render();
    const std::vector<float> variance = film.variance();
    for (std::size_t i = 0; i < 16; ++i) {
      mean[i] += film.means[i] / pictures;
      square[i] += film.means[i] * film.means[i] / pictures;
      stated[i] += static_cast<double>(variance[i]) / pictures;
    }
  }
  double actualSum = 0.0, statedSum = 0.0;
  for (std::size_t i = 0; i < 16; ++i) {
    actualSum += (square[i] - mean[i] * mean[i]) * pictures / (pictures - 1.0) / (mean[i] * mean[i]);
    statedSum += stated[i] / (mean[i] * mean[i]);
  }
  // 16 pixels with 47 degrees of freedom each have 5 % standard deviation, more where tails are heavy.
  EXPECT_NEAR(actualSum / statedSum, 1.0, 0.25);
}

TEST(Reference, Error_IsReachedAndNotFarOvershot) {
  Shot shot = cornerShot();
  shot.request.error = 0.05;
  const Film film = shot.render();
  EXPECT_LE(film.relativeError(), 0.05);
  EXPECT_GT(film.relativeError(), 0.02);
}

TEST(Reference, Interrupted_GoesOnToTheSameBits) {
  Shot shot = cornerShot();
  // The picture has more than one block: a stop may fall between blocks of a pass.
  shot.request.width = shot.request.height = 160;
  shot.request.samples = 96;
  shot.request.depth = 3;
  shot.request.guides = true;
  shot.request.parts = true;
  const auto draw = [&](Progress& progress) {
    Film film(160, 160, true);
    reference::ReferenceReport report;
    reference::renderReference(shot.inputs(), shot.request, sharedDevice(), progress, film, report);
    return std::pair(film, report.guides);
  };
  Progress progress;
  const auto [whole, guides] = draw(progress);
  const auto [film, guidesInParts] = inManyRuns(draw, 3);
  EXPECT_TRUE(same(film, whole));
  EXPECT_EQ(guidesInParts.albedo, guides.albedo);
  EXPECT_EQ(guidesInParts.normal, guides.normal);
  EXPECT_EQ(guidesInParts.noisy, guides.noisy);
}

TEST(FilmState, OfAnotherPicture_NamesTheDifference) {
  Shot shot = cornerShot();
  const TemporaryFolder folder;
  const auto path = folder / "a.exr.state";
  const auto key = [&] { return reference::filmKey(shot.inputs(), shot.request, sharedDevice().info()); };
  StateLog(path, "reference", key()).commit(0.0);
  EXPECT_TRUE(StateLog::open(path, "reference", key()).has_value());
  const auto refusal = [&]() -> std::string {
    try {
      (void)StateLog::open(path, "reference", key());
    } catch (const UsageError& error) {
      return error.what();
    }
    return "";
  };
  shot.request.depth = 7;
  shot.request.seed = 3;
  EXPECT_NE(refusal().find("depth"), std::string::npos) << refusal();
  EXPECT_NE(refusal().find("seed"), std::string::npos) << refusal();
  EXPECT_EQ(refusal().find("size"), std::string::npos) << refusal();
  shot = cornerShot();
  shot.scene.materials[0].baseColor.x = 0.1f;
  EXPECT_NE(refusal().find("another scene"), std::string::npos) << refusal();
  shot = cornerShot();
  shot.sky = constantEnvironment(glm::vec3(1.0f));
  EXPECT_NE(refusal().find("another sky"), std::string::npos) << refusal();
}

TEST(FilmState, OfAnotherAnimationOrMoment_IsAnother) {
  Warnings warnings;
  Scene scene = loadScene(makeBuiltinScene("swing"), warnings);
  setPose(scene, 0, 0.0);
  const CompiledScene compiled = compileScene(scene, warnings);
  reference::ReferenceInputs inputs{compiled, scene.images, scene.lights,
                                    cameraAt({0, 1, 5}, {0, 0, 0}, 1.0)};
  reference::ReferenceRequest request;
  request.shutter = 0.5;
  const auto key = [&] {
    inputs.motion = reference::Exposure(scene, inputs, {}, request).motion();
    return reference::filmKey(inputs, request, sharedDevice().info());
  };
  const StateKey swing = key();
  EXPECT_EQ(key(), swing);
  const Scene same = scene;
  scene.animations[0].samplers[0].values.back().x += 0.25f;  // later than the moment that the key sees
  EXPECT_NE(key(), swing);
  scene = same;
  scene.moment->seconds = 0.25;
  EXPECT_NE(key(), swing);
  scene = same;
  scene.animations.push_back(scene.animations[0]);
  scene.moment->animation = 1;
  EXPECT_NE(key(), swing);
}

}  // namespace
}  // namespace prelight::test
