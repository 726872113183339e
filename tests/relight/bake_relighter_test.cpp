#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>
#include <string>
#include <vector>

#include "basis/haar.h"
#include "compress/compression_error.h"
#include "occluders/occluder_light.h"
#include "oracle/relighting.h"
#include "prelight/basis.h"
#include "prelight/error.h"
#include "prelight/harmonic_lights.h"
#include "prelight/load.h"
#include "prelight/relighter.h"
#include "support/devices.h"
#include "support/occluders.h"
#include "techniques/haar/haar_model.h"

/// OpenCL's function without its types.
extern "C" int clEnqueueReadBuffer(void* queue, void* buffer, unsigned blocking, std::size_t offset,
                                   std::size_t bytes, void* to, unsigned waits, const void* waitList,
                                   void* event);

namespace prelight {
namespace {

using ::testing::HasSubstr;

constexpr std::size_t receivers = 101;  ///< Neither a multiple of a tile nor of a group.
constexpr int bakedOrder = 4;
constexpr std::size_t bakedTerms = 16;

std::vector<float> noise(std::size_t count, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<float> uniform(-1, 1);
  std::vector<float> values(count);
  for (float& value : values) value = uniform(random);
  return values;
}

HarmonicTransfer noisyTransfer(int channels, unsigned seed = 1) {
  return {bakedOrder, channels, 0, noise(receivers * static_cast<std::size_t>(channels) * bakedTerms, seed)};
}

Environment noisySky() {
  Environment sky{40, 21, {}};
  const std::vector<float> values = noise(3 * 40 * 21, 20);
  for (std::size_t i = 0; i < values.size(); i += 3)
    sky.radiance.emplace_back(1.0f + values[i], 1.0f + values[i + 1], 1.0f + values[i + 2]);
  return sky;
}

glm::dmat3 obliqueTurn() { return {{0.0, 0.6, 0.8}, {1.0, 0.0, 0.0}, {0.0, 0.8, -0.6}}; }

/// A directional light and one as wide as 20 degrees.
std::vector<DistantLight> twoLights() {
  return {{{1.0, 2.0, 3.0}, {2.0, 1.0, 0.5}, 0.0}, {{-2.0, 0.5, 0.1}, {0.5, 1.0, 3.0}, 0.35}};
}

/// Light of every kind, and its coefficients in double precision.
struct MixedLight {
  Environment sky = noisySky();
  std::vector<DistantLight> lights = twoLights();
  std::vector<double> further;  ///< Of one band more than the transfer.

  MixedLight() {
    for (const float value : noise(75, 21)) further.push_back(value);
  }

  RelighterLight given() const {
    return {.sky = &sky, .lights = lights, .coefficients = further, .rotation = obliqueTurn()};
  }

  std::vector<double> coefficients() const {
    std::vector<double> sum = projectSky(sky, bakedOrder);
    for (const DistantLight& light : lights) {
      const double sine = std::sin(light.halfAngle);
      const bool wide = light.halfAngle > 0.0;
      const std::vector<double> one = wide ? shOfCap(light.towards, light.halfAngle, bakedOrder)
                                           : shOfDirection(light.towards, bakedOrder);
      for (std::size_t c = 0; c < 3; ++c)
        for (std::size_t i = 0; i < bakedTerms; ++i)
          sum[c * bakedTerms + i] +=
              one[i] * light.irradiance[static_cast<int>(c)] / (wide ? std::numbers::pi * sine * sine : 1.0);
    }
    for (std::size_t c = 0; c < 3; ++c)
      for (std::size_t i = 0; i < bakedTerms; ++i) sum[c * bakedTerms + i] += further[c * 25 + i];
    return rotateHarmonics(HarmonicBasis::Sh, sum, bakedOrder, obliqueTurn());
  }
};

std::vector<glm::vec3> radianceOf(Relighter& relighter) {
  std::vector<glm::vec3> radiance(relighter.receiverCount());
  relighter.relight(radiance);
  return radiance;
}

/// Expects a difference of at most 1e-5 relative to the RMS of the correct values.
void expectColors(const std::vector<glm::vec3>& got, const std::vector<glm::dvec3>& right,
                  double tolerance = 1e-5) {
  ASSERT_EQ(got.size(), right.size());
  double square = 0.0;
  for (const glm::dvec3& color : right) square += glm::dot(color, color) / (3.0 * double(right.size()));
  ASSERT_GT(square, 0.0);
  for (std::size_t v = 0; v < right.size(); ++v)
    for (int c = 0; c < 3; ++c)
      ASSERT_NEAR(got[v][c], right[v][c], tolerance * std::sqrt(square)) << "receiver " << v;
}

std::vector<glm::vec3> relit(const Bake& bake, const RelighterLight& light,
                             const RelighterOptions& options = {}) {
  Relighter relighter(bake, test::sharedDevice(), options);
  relighter.light(light);
  return radianceOf(relighter);
}

TEST(BakeRelighter, ShUnderEveryKindOfLight_AgreesWithDoubleReference) {
  const MixedLight light;
  for (const int channels : {1, 3}) {
    Bake bake;
    bake.sh = noisyTransfer(channels);
    expectColors(relit(bake, light.given()), relight(*bake.sh, light.coefficients()));
  }
}

/// Its radiance would be infinite, and its solid angle 0.
TEST(BakeRelighter, LightOfNoMeasurableSize_IsADirection) {
  Bake bake;
  bake.sh = noisyTransfer(1);
  const std::vector<glm::vec3> direction =
      relit(bake, {.lights = {{.towards = {1.0, 2.0, 3.0}, .irradiance = glm::dvec3(1.0)}}});
  for (const double halfAngle : {1e-200, 1e-7, 1e-6, 1e-4}) {
    const DistantLight light{{1.0, 2.0, 3.0}, glm::dvec3(1.0), halfAngle};
    const std::vector<glm::vec3> small = relit(bake, {.lights = {light}});
    for (std::size_t v = 0; v < receivers; ++v)
      ASSERT_NEAR(small[v].x, direction[v].x, 1e-5) << v << ", " << halfAngle;
  }
}

/// More bands than transfer can have are ignored as others that it lacks.
TEST(BakeRelighter, CoefficientsOfAnyOrder_GiveTheirFirstBands) {
  Bake bake;
  bake.sh = noisyTransfer(1);
  std::vector<double> few(3 * bakedTerms), many(3 * 40 * 40);
  for (std::size_t c = 0; c < 3; ++c)
    for (std::size_t i = 0; i < 1600; ++i) {
      many[c * 1600 + i] = std::cos(double(c * 1600 + i));
      if (i < bakedTerms) few[c * bakedTerms + i] = many[c * 1600 + i];
    }
  EXPECT_EQ(relit(bake, {.coefficients = many, .rotation = obliqueTurn()}),
            relit(bake, {.coefficients = few, .rotation = obliqueTurn()}));
}

TEST(BakeRelighter, CompressedSh_AgreesWithWhatItStandsFor) {
  const MixedLight light;
  for (const char* method : {"half", "band8", "rgbe", "pca:5", "vq:20", "cpca:5:8:byte"}) {
    SCOPED_TRACE(method);
    Bake bake;
    bake.compressedSh = compress(noisyTransfer(3), parseCompression(method));
    expectColors(relit(bake, light.given()), relight(decompress(*bake.compressedSh), light.coefficients()));
  }
}

/// CH of a transfer are its SH in other functions, so that the result is the same.
TEST(BakeRelighter, Ch_AgreesWithTheSameTransferInSh) {
  const MixedLight light;
  const HarmonicTransfer sh = noisyTransfer(3);
  Bake bake;
  bake.ch = sh;
  const std::vector<double> rows(sh.coefficients.begin(), sh.coefficients.end());
  const std::vector<double> ch = chFromSh(rows, bakedOrder);
  bake.ch->coefficients.assign(ch.begin(), ch.end());
  expectColors(relit(bake, light.given()), relight(sh, light.coefficients()));
}

TEST(BakeRelighter, Keys_AreBlendedByTime) {
  const MixedLight light;
  Bake bake;
  bake.sh = noisyTransfer(3, 9);
  bake.animation = AnimatedTransfer{.times = {1.0, 3.0, 4.0},
                                    .keys = {noisyTransfer(3, 1), noisyTransfer(3, 2), noisyTransfer(3, 3)}};
  Relighter relighter(bake, test::sharedDevice());
  EXPECT_EQ(relighter.technique(), "animation");
  relighter.light(light.given());
  const auto at = [&](std::size_t key) { return relight(bake.animation->keys[key], light.coefficients()); };
  expectColors(radianceOf(relighter), at(0));
  for (const auto& [time, key] : {std::pair{0.0, 0}, {3.0, 1}, {4.0, 2}, {99.0, 2}}) {
    relighter.setTime(time);
    expectColors(radianceOf(relighter), at(static_cast<std::size_t>(key)));
  }
  relighter.setTime(1.5);
  std::vector<glm::dvec3> between = at(0);
  const std::vector<glm::dvec3> after = at(1);
  for (std::size_t v = 0; v < receivers; ++v) between[v] = glm::mix(between[v], after[v], 0.25);
  expectColors(radianceOf(relighter), between);
  EXPECT_THROW(relighter.setTime(std::nan("")), UsageError);
}

/// Texels of several maps, and cells, are receivers as vertices are; both may be stored compressed.
TEST(BakeRelighter, TexelsAndVolumes_AgreeWithDoubleReference) {
  const MixedLight light;
  const HarmonicTransfer rows = noisyTransfer(3);
  const std::vector<glm::dvec3> right = relight(rows, light.coefficients());
  const auto split = rows.coefficients.begin() + 35 * 3 * bakedTerms;
  Bake bake;
  bake.chartTransfer.emplace();
  bake.chartTransfer->order = bakedOrder;
  bake.chartTransfer->channels = 3;
  bake.chartTransfer->maps = {{0, 7, 5, {}, {rows.coefficients.begin(), split}},
                              {2, 11, 6, {}, {split, rows.coefficients.end()}}};
  bake.volume.emplace();
  bake.volume->order = bakedOrder;
  bake.volume->channels = 3;
  bake.volume->coefficients = rows.coefficients;
  expectColors(relit(bake, light.given()), right);
  expectColors(relit(bake, light.given(), {.technique = "volume"}), right);

  bake.compressedParts.texels = compress(rows, parseCompression("cpca:4:6"));
  const HarmonicTransfer unpacked = decompress(*bake.compressedParts.texels);
  expectColors(relit(bake, light.given()), relight(unpacked, light.coefficients()));
}

HaarTransfer noisyWavelets(int faceSize) {
  std::mt19937 random(8);
  HaarTransfer transfer;
  transfer.faceSize = faceSize;
  transfer.channels = 3;
  transfer.offsets = {0};
  const auto texels = static_cast<std::uint32_t>(6 * faceSize * faceSize);
  for (std::size_t row = 0; row < 3 * receivers; ++row) {
    for (std::uint32_t i = 0; i < texels; ++i)
      if (random() % 4 == 0) {
        transfer.indices.push_back(i);
        transfer.values.push_back(std::uniform_real_distribution<float>(-1, 1)(random));
      }
    transfer.offsets.push_back(static_cast<std::uint32_t>(transfer.indices.size()));
  }
  return transfer;
}

/// Returns the coefficients of a cube map, [channel][i].
std::vector<float> waveletsOf(const std::vector<glm::vec3>& texels, const glm::dmat3& turn, int faceSize) {
  std::vector<float> planes(3 * texels.size());
  for (std::size_t t = 0; t < texels.size(); ++t)
    for (std::size_t c = 0; c < 3; ++c) planes[c * texels.size() + t] = texels[t][static_cast<int>(c)];
  planes = rotateCube(planes, faceSize, turn);
  haarForward(planes, faceSize);
  return planes;
}

std::vector<haar::LitWavelet> litBy(const haar::SparseLight& light) {
  std::vector<haar::LitWavelet> lit;
  for (std::size_t i = 0; i < light.indices.size(); ++i) lit.push_back({light.indices[i], light.values[i]});
  return lit;
}

TEST(BakeRelighter, Wavelets_AgreeWithDoubleReference) {
  const Environment sky = noisySky();
  Bake bake;
  bake.haar = noisyWavelets(4);
  const std::vector<float> light = waveletsOf(cubeOfSky(sky, 4), obliqueTurn(), 4);
  const RelighterLight given{.sky = &sky, .rotation = obliqueTurn()};
  const haar::SparseLight all = haar::selectLight(light, std::vector<float>(96, 1.0f), 96);
  expectColors(relit(bake, given), reference::relightHaar(*bake.haar, litBy(all)));

  const haar::SparseLight few =
      haar::selectFitted(light, 12, haar::modelTransfer(*bake.haar, haar::usualRank));
  Relighter relighter(bake, test::sharedDevice(), {.wavelets = 12});
  relighter.light(given);
  expectColors(radianceOf(relighter), reference::relightHaar(*bake.haar, litBy(few)), 1e-4);
  const std::size_t fewBytes = relighter.bytesMoved();
  Relighter whole(bake, test::sharedDevice());
  whole.light(given);
  EXPECT_LT(3 * fewBytes, whole.bytesMoved());
}

/// A light that is turned is the light in the turned direction, and its irradiance is what the cube holds.
TEST(BakeRelighter, LightsOfWavelets_HaveTheirIrradiance) {
  // A row of averages only: the result is the mean radiance x 6 faces.
  HaarTransfer averages;
  averages.faceSize = 8;
  averages.offsets = {0, 6};
  for (std::uint32_t face = 0; face < 6; ++face) {
    averages.indices.push_back(64 * face);
    averages.values.push_back(1.0f / 8.0f);
  }
  Bake bake;
  bake.haar = averages;
  const std::vector<DistantLight> sun{{{0.0, 0.0, 2.0}, {3.0, 2.0, 1.0}, 0.0}};
  const std::vector<glm::vec3> before = relit(bake, {.lights = sun});
  const std::vector<glm::vec3> after =
      relit(bake, {.lights = sun, .rotation = {{0, 1, 0}, {0, 0, 1}, {1, 0, 0}}});
  EXPECT_NEAR(before[0].x / before[0].z, 3.0, 1e-5);
  EXPECT_NEAR(before[0].x, after[0].x, 1e-4f * before[0].x);
  for (const double halfAngle : {1e-200, 1e-6, 1e-3}) {
    const DistantLight small{sun[0].towards, sun[0].irradiance, halfAngle};
    EXPECT_NEAR(relit(bake, {.lights = {small}})[0].x, before[0].x, 0.01f * before[0].x) << halfAngle;
  }
}

/// Rows of open receivers times `share`, and their normals.
struct OpenReceivers {
  LoadedScene scene;
  Bake bake;

  OpenReceivers(int order, int channels, double share) {
    const std::vector<float> numbers = noise(3 * receivers, 30);
    bake.sh = HarmonicTransfer{order, channels, 0, {}};
    for (std::size_t v = 0; v < receivers; ++v) {
      const glm::dvec3 normal =
          glm::normalize(glm::dvec3(numbers[3 * v], numbers[3 * v + 1], numbers[3 * v + 2]));
      scene.compiled.normals.emplace_back(normal);
      const std::vector<double> row = rotateZonal(zonalClampedCosine(order), normal);
      for (int c = 0; c < channels; ++c)
        for (const double value : row) bake.sh->coefficients.push_back(static_cast<float>(share * value));
    }
  }
};

/// With a share of a half, sharper edges of shadows change nothing.
TEST(BakeRelighter, DistantLightsInFewBands_AreExactByNormals) {
  const std::vector<DistantLight> lights = twoLights();
  struct Case {
    int order, channels;
    double share;
  };
  for (const Case& one : {Case{2, 1, 1.0}, {3, 1, 1.0}, {3, 3, 1.0}, {2, 3, 0.5}, {3, 3, 0.0}, {4, 1, 0.5}}) {
    SCOPED_TRACE(std::to_string(one.order) + " bands, " + std::to_string(one.channels) + " channels");
    OpenReceivers made(one.order, one.channels, one.share);
    std::vector<glm::dvec3> right(receivers, glm::dvec3(0.0));
    for (std::size_t v = 0; v < receivers; ++v)
      for (const DistantLight& light : lights) {
        const double cosine = glm::dot(obliqueTurn() * glm::normalize(light.towards),
                                       glm::dvec3(made.scene.compiled.normals[v]));
        right[v] += one.share * std::max(cosine, 0.0) / std::numbers::pi * light.irradiance;
      }
    const RelighterLight light{.lights = lights, .rotation = obliqueTurn()};
    const std::vector<glm::vec3> got = relit(made.bake, light, {.scene = &made.scene});
    for (std::size_t v = 0; v < receivers; ++v)
      for (int c = 0; c < 3; ++c) ASSERT_NEAR(got[v][c], right[v][c], 1e-4) << "receiver " << v;
    made.bake.ch = made.bake.sh;
    const std::vector<double> rows(made.bake.sh->coefficients.begin(), made.bake.sh->coefficients.end());
    const std::vector<double> ch = chFromSh(rows, one.order);
    made.bake.ch->coefficients.assign(ch.begin(), ch.end());
    const std::vector<glm::vec3> same = relit(made.bake, light, {.technique = "ch", .scene = &made.scene});
    for (std::size_t v = 0; v < receivers; ++v) ASSERT_NEAR(same[v].x, right[v].x, 1e-4) << "receiver " << v;
  }
}

/// Other light is as without normals, and a light that goes out leaves nothing.
TEST(BakeRelighter, LightAfterDistantLights_IsAlone) {
  OpenReceivers made(4, 3, 0.7);
  const MixedLight light;
  RelighterLight others = light.given();
  others.lights.clear();
  Relighter relighter(made.bake, test::sharedDevice(), {.scene = &made.scene});
  relighter.light(light.given());
  EXPECT_NE(radianceOf(relighter), relit(made.bake, others));
  relighter.light(others);
  EXPECT_EQ(radianceOf(relighter), relit(made.bake, others));
  made.scene.compiled.normals.pop_back();
  EXPECT_THROW(Relighter(made.bake, test::sharedDevice(), {.scene = &made.scene}), InputError);
}

TEST(BakeRelighter, LightGroups_AreAddedWithTheirColours) {
  const MixedLight light;
  Bake bake;
  bake.sh = noisyTransfer(3);
  bake.lightGroups = LightGroupTransfer{
      .groups = {{"lamp"}, {"window"}}, .channels = 3, .coefficients = noise(receivers * 6, 5)};
  const std::vector<glm::vec3> colors{{1.0f, 0.5f, 0.25f}, {0.0f, 2.0f, 3.0f}};
  const std::vector<glm::dvec3> lamps =
      reference::relightGroups(*bake.lightGroups, std::vector<glm::dvec3>(colors.begin(), colors.end()));
  std::vector<glm::dvec3> both = relight(*bake.sh, light.coefficients());
  expectColors(relit(bake, light.given()), both);
  RelighterLight given = light.given();
  given.groups = colors;
  for (std::size_t v = 0; v < receivers; ++v) both[v] += lamps[v];
  expectColors(relit(bake, given), both);

  bake.sh.reset();
  expectColors(relit(bake, {.groups = colors}), lamps);
  EXPECT_THROW(relit(bake, given), UsageError) << "there is nothing for the sky";
  EXPECT_THROW(relit(bake, {.groups = {colors[0]}}), UsageError);
}

TEST(BakeRelighter, LightWithAnotherNumberOfGroups_LeavesTheLightAsItWas) {
  const MixedLight light;
  Bake bake;
  bake.sh = noisyTransfer(3);
  bake.lightGroups =
      LightGroupTransfer{.groups = {{"lamp"}}, .channels = 1, .coefficients = noise(receivers, 5)};
  Relighter relighter(bake, test::sharedDevice());
  relighter.light(light.given());
  const std::vector<glm::vec3> before = radianceOf(relighter);
  EXPECT_THROW(relighter.light({.groups = std::vector<glm::vec3>(2, glm::vec3(1.0f))}), UsageError);
  EXPECT_EQ(radianceOf(relighter), before);
}

TEST(BakeRelighter, VectorOccluders_AgreeWithDoubleReference) {
  const test::MadeOccluders made = test::makeOccluders(receivers, test::everyOptionalVector(), 3);
  Bake bake;
  bake.occluders = made.transfer;
  LoadedScene scene;
  scene.compiled.positions = made.positions;
  scene.compiled.normals = made.normals;
  const std::vector<DistantLight> lights = twoLights();
  std::vector<LightAt> sources;
  for (const DistantLight& light : lights)
    sources.emplace_back([&light](const glm::dvec3&) {
      return IncidentLight{light.irradiance, glm::normalize(obliqueTurn() * light.towards)};
    });
  std::vector<glm::dvec3> right;
  for (std::size_t v = 0; v < receivers; ++v) {
    OccluderReceiver receiver = test::receiverOf(made, v, {2.0, 3.0, 5.0});
    receiver.f0 = glm::dvec3(0.0);
    receiver.roughness = 1.0;
    right.push_back(litThroughOccluders(made.transfer, receiver, sources, {}).diffuse);
  }
  const RelighterLight light{.lights = lights, .rotation = obliqueTurn()};
  expectColors(relit(bake, light, {.scene = &scene}), right, 1e-4);
  EXPECT_THROW(relit(bake, light), UsageError) << "without positions";
  for (const glm::vec3& color : relit(bake, {}, {.scene = &scene})) EXPECT_EQ(color, glm::vec3(0.0f));
}

TEST(BakeRelighter, BeforeItsFirstLight_IsBlack) {
  Bake bake;
  bake.sh = noisyTransfer(1);
  Relighter relighter(bake, test::sharedDevice());
  for (const glm::vec3& color : radianceOf(relighter)) EXPECT_EQ(color, glm::vec3(0.0f));
}

TEST(BakeRelighter, Reason_SaysWhatWasChosenAndWhatElseThereIs) {
  Bake bake;
  bake.sh = noisyTransfer(3);
  bake.haar = noisyWavelets(2);
  bake.lightGroups =
      LightGroupTransfer{.groups = {{"lamp"}}, .channels = 1, .coefficients = noise(receivers, 5)};
  EXPECT_EQ(Relighter(bake, test::sharedDevice()).reason(),
            "sh: order 4, 3 channels, rows of floats; preferred; the bake also has haar, light_groups");
  const Relighter wanted(bake, test::sharedDevice(), {.technique = "haar"});
  EXPECT_EQ(wanted.technique(), "haar");
  EXPECT_THAT(wanted.reason(), HasSubstr("chosen by RelighterOptions::technique"));
}

TEST(BakeRelighter, TransferThatWasNotBaked_IsNamed) {
  Bake bake;
  EXPECT_THROW(Relighter(bake, test::sharedDevice()), InputError);
  bake.sh = noisyTransfer(1);
  try {
    const Relighter relighter(bake, test::sharedDevice(), {.technique = "volume"});
    FAIL() << "no error";
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("it has no volume, only sh"));
  }
  EXPECT_THROW(Relighter(bake, test::sharedDevice(), {.technique = "sky"}), UsageError);
  EXPECT_THAT(relitTechniques(),
              ::testing::UnorderedElementsAre("sh", "animation", "ch", "light_groups", "haar",
                                              "vector_occluders", "volume", "texels"));
}

TEST(BakeRelighter, LightThatMakesNoSense_IsRefused) {
  Bake bake;
  bake.sh = noisyTransfer(1);
  Relighter relighter(bake, test::sharedDevice());
  const std::vector<double> seven(7), broken(48, std::nan(""));
  const std::vector<glm::vec3> colors(1);
  Environment sky = noisySky();
  sky.radiance[5].y = -1.0f;
  std::vector<glm::vec3> small(receivers - 1);
  const auto lit = [](const DistantLight& light) { return std::vector<DistantLight>{light}; };
  EXPECT_THROW(relighter.light({.coefficients = seven}), UsageError);
  EXPECT_THROW(relighter.light({.coefficients = broken}), UsageError);
  EXPECT_THROW(relighter.light({.rotation = glm::dmat3(2.0)}), UsageError);
  EXPECT_THROW(relighter.light({.groups = colors}), UsageError);
  EXPECT_THROW(relighter.light({.sky = &sky}), InputError);
  EXPECT_THROW(relighter.light({.lights = lit({.towards = {0.0, 0.0, 0.0}})}), UsageError);
  EXPECT_THROW(relighter.light({.lights = lit({.irradiance = {0.0, -1.0, 0.0}})}), UsageError);
  EXPECT_THROW(relighter.light({.lights = lit({.halfAngle = 1.6})}), UsageError);
  EXPECT_THROW(relighter.setTime(0.0), UsageError);
  EXPECT_THROW(relighter.relight(small), UsageError);
}

/// Other kernels of the same queue see what the relighter wrote.
TEST(DeviceColors, OpenClBuffer_HoldsTheRadiance) {
  Bake bake;
  bake.sh = noisyTransfer(3);
  const MixedLight light;
  Relighter relighter(bake, test::sharedDevice());
  relighter.light(light.given());
  const DeviceColors& colors = relighter.relight();
  std::vector<glm::vec3> read(receivers), own(receivers);
  const OpenClHandles handles = openclHandles(test::sharedDevice());
  ASSERT_EQ(clEnqueueReadBuffer(handles.queue, colors.openclBuffer(), 1, 0, sizeof(glm::vec3) * receivers,
                                own.data(), 0, nullptr, nullptr),
            0);
  colors.read(read);
  EXPECT_EQ(read, own);
  EXPECT_NE(handles.context, nullptr);
  EXPECT_NE(handles.device, nullptr);
}

TEST(SkyProjector, TurnedSky_IsProjectedAsTheHostDoes) {
  const Environment sky = noisySky();
  SkyProjector projector(test::sharedDevice(), sky.width, sky.height, 5);
  projector.setSky(sky);
  projector.setRotation(obliqueTurn());
  const std::vector<double> got = projector.projectSh(),
                            right = rotateHarmonics(HarmonicBasis::Sh, projectSky(sky, 5), 5, obliqueTurn());
  for (std::size_t i = 0; i < right.size(); ++i) EXPECT_NEAR(got[i], right[i], 1e-5) << i;
  EXPECT_THROW(SkyProjector(test::sharedDevice(), 0, 4, 2), UsageError);
  EXPECT_THROW(SkyProjector(test::sharedDevice(), 8, 4, 33), UsageError);
  EXPECT_THROW(projector.projectWavelets(8, 0), UsageError);
  EXPECT_THROW(projector.projectWavelets(8, 65536), UsageError) << "whose square wraps to 0";
  Environment longer = sky, broken = sky;
  longer.radiance.emplace_back(1.0f);
  broken.radiance[5].y = std::nanf("");
  EXPECT_THROW(projector.setSky(longer), InputError);
  EXPECT_THROW(projector.setSky(broken), InputError);
}

TEST(SkyProjector, BeforeItsFirstSky_IsBlack) {
  SkyProjector projector(test::sharedDevice(), 40, 21, 3);
  for (const double value : projector.projectSh()) EXPECT_EQ(value, 0.0);
  for (const float value : projector.projectWavelets(4)) EXPECT_EQ(value, 0.0f);
}

/// A sky that is bright around +X is bright around +Y after a quarter turn about z.
TEST(SkyProjector, WaveletsOfATurnedSky_LieAtTheTurnedDirection) {
  Environment sky{64, 32, {}};
  for (int row = 0; row < sky.height; ++row)
    for (int column = 0; column < sky.width; ++column)
      sky.radiance.emplace_back(
          1.0 + Environment::direction((column + 0.5) / sky.width, (row + 0.5) / sky.height).x);
  SkyProjector projector(test::sharedDevice(), sky.width, sky.height, 1);
  projector.setSky(sky);
  projector.setRotation({{0.0, 1.0, 0.0}, {-1.0, 0.0, 0.0}, {0.0, 0.0, 1.0}});
  std::vector<float> texels = projector.projectWavelets(4, 16);
  haarInverse(texels, 4);
  const std::vector<glm::dvec3> directions = cubeDirections(4);
  for (std::size_t t = 0; t < directions.size(); ++t)
    EXPECT_NEAR(texels[t], 1.0 + directions[t].y, 0.03) << t;
}

}  // namespace
}  // namespace prelight
