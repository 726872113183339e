#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "compress/compression_error.h"
#include "oracle/relighting.h"
#include "prelight/error.h"
#include "relight/device/cluster_relighter.h"
#include "relight/device/compressed_light.h"
#include "relight/device/dense_relighter.h"
#include "relight/device/keyframe_relighter.h"
#include "support/devices.h"
#include "support/scenes.h"
#include "techniques/glossy/glossy_relighter.h"
#include "techniques/haar/haar_relighter.h"

namespace prelight {
namespace {

/// Neither a multiple of a tile nor of a group.
constexpr std::size_t vertexCount = 333;

DeviceContext& device() { return test::sharedDevice().context(); }

std::vector<float> randomFloats(std::size_t count, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<float> uniform(-1, 1);
  std::vector<float> values(count);
  for (float& value : values) value = uniform(random);
  return values;
}

std::vector<double> randomLight(std::size_t count, unsigned seed) {
  const auto values = randomFloats(3 * count, seed);
  return {values.begin(), values.end()};
}

HarmonicTransfer randomTransfer(int order, int channels, unsigned seed = 1) {
  return {order, channels, 0,
          randomFloats(vertexCount * static_cast<std::size_t>(channels * order * order), seed)};
}

/// Expects a difference of at most `tolerance` relative to the RMS of the correct values.
void expectNear(const Buffer<float>& radiance, const std::vector<glm::dvec3>& right, double tolerance) {
  ASSERT_EQ(radiance.size(), 3 * right.size());
  const std::vector<float> got = radiance.read();
  double square = 0.0;
  for (const glm::dvec3& color : right) square += glm::dot(color, color) / (3.0 * double(right.size()));
  ASSERT_GT(square, 0.0);
  for (std::size_t v = 0; v < right.size(); ++v)
    for (int c = 0; c < 3; ++c)
      ASSERT_NEAR(got[3 * v + static_cast<std::size_t>(c)], right[v][c], tolerance * std::sqrt(square))
          << "vertex " << v << ", colour " << c;
}

class Dense : public ::testing::TestWithParam<std::tuple<int, int>> {};

TEST_P(Dense, Float_AgreesWithDoubleReference) {
  const auto [order, channels] = GetParam();
  const HarmonicTransfer transfer = randomTransfer(order, channels);
  const auto light = randomLight(static_cast<std::size_t>(order * order), 2);
  DenseRelighter relighter(device(), transfer);
  relighter.setLight(light);
  Buffer<float> radiance(device(), 3 * vertexCount);
  relighter.relight(radiance);
  expectNear(radiance, relight(transfer, light), 1e-5);
}

TEST_P(Dense, CompressedTransfer_AgreesWithDoubleReference) {
  const auto [order, channels] = GetParam();
  const HarmonicTransfer transfer = randomTransfer(order, channels);
  const auto light = randomLight(static_cast<std::size_t>(order * order), 3);
  for (const char* method : {"half", "band8"}) {
    const CompressedTransfer compressed = compress(transfer, parseCompression(method));
    DenseRelighter relighter(device(), compressed);
    relighter.setLight(light);
    Buffer<float> radiance(device(), 3 * vertexCount);
    relighter.relight(radiance);
    SCOPED_TRACE(method);
    expectNear(radiance, relight(decompress(compressed), light), 1e-5);
  }
}

INSTANTIATE_TEST_SUITE_P(OrdersAndChannels, Dense,
                         ::testing::Combine(::testing::Values(1, 3, 6), ::testing::Values(1, 3)));

TEST(DenseRelighter, EveryHalf_IsConvertedExactly) {
  HarmonicTransfer transfer{1, 1, 0, {}};
  CompressedTransfer compressed = compress(transfer, parseCompression("half"));
  for (std::uint32_t half = 0; half < 0x7c00; ++half) {
    compressed.halves.push_back(static_cast<std::uint16_t>(half));
    compressed.halves.push_back(static_cast<std::uint16_t>(half | 0x8000));
  }
  compressed.vertexCount = static_cast<std::uint32_t>(compressed.halves.size());
  DenseRelighter relighter(device(), compressed);
  relighter.setLight(std::vector<double>{1.0, 1.0, 1.0});
  Buffer<float> radiance(device(), 3 * compressed.halves.size());
  relighter.relight(radiance);
  const auto expected = decompress(compressed).coefficients;
  const auto got = radiance.read();
  for (std::size_t v = 0; v < expected.size(); ++v)
    ASSERT_EQ(got[3 * v], expected[v]) << compressed.halves[v];
}

TEST(DenseRelighter, LightGroups_AreScaledAndColoured) {
  for (const int channels : {1, 3}) {
    LightGroupTransfer transfer;
    transfer.groups = {{"lamp"}, {"window"}, {"sign"}, {"screen"}, {"exit"}};
    transfer.channels = channels;
    transfer.coefficients = randomFloats(vertexCount * static_cast<std::size_t>(channels) * 5, 4);
    const auto flat = randomLight(5, 5);
    std::vector<glm::dvec3> colors;
    for (std::size_t g = 0; g < 5; ++g) colors.emplace_back(flat[g], flat[5 + g], flat[10 + g]);
    DenseRelighter relighter(device(), {5, static_cast<std::size_t>(channels)}, transfer.coefficients);
    relighter.setLight(flat);
    Buffer<float> radiance(device(), 3 * vertexCount);
    relighter.relight(radiance);
    expectNear(radiance, reference::relightGroups(transfer, colors), 1e-5);
  }
}

TEST(DenseRelighter, WrongLightOrMethod_IsNamed) {
  DenseRelighter relighter(device(), randomTransfer(3, 1));
  EXPECT_THROW(relighter.setLight(std::vector<double>(9)), UsageError);
  const CompressedTransfer clustered = compress(randomTransfer(2, 1), parseCompression("vq:4"));
  EXPECT_THROW(DenseRelighter(device(), clustered), UsageError);
  const CompressedTransfer halves = compress(randomTransfer(2, 1), parseCompression("half"));
  EXPECT_THROW(ClusterRelighter(device(), halves), UsageError);
}

TEST(KeyframeRelighter, Blend_IsTheLightOfBlendedCoefficients) {
  const std::vector<HarmonicTransfer> keys = {randomTransfer(4, 3, 1), randomTransfer(4, 3, 2),
                                              randomTransfer(4, 3, 3)};
  const auto light = randomLight(16, 6);
  KeyframeRelighter relighter(device(), keys);
  relighter.setLight(light);
  Buffer<float> radiance(device(), 3 * vertexCount);
  for (const double blend : {0.0, 0.3, 1.0}) {
    HarmonicTransfer between = keys[1];
    for (std::size_t i = 0; i < between.coefficients.size(); ++i)
      between.coefficients[i] =
          static_cast<float>((1.0 - blend) * keys[1].coefficients[i] + blend * keys[2].coefficients[i]);
    relighter.setMoment(1, blend);
    relighter.relight(radiance);
    expectNear(radiance, relight(between, light), 1e-5);
  }
  relighter.setMoment(2, 0.0);
  relighter.relight(radiance);
  expectNear(radiance, relight(keys[2], light), 1e-5);
  EXPECT_THROW(relighter.setMoment(2, 0.1), UsageError);
  EXPECT_THROW(relighter.setMoment(3, 0.0), UsageError);
  EXPECT_THROW(relighter.setMoment(0, 1.5), UsageError);
  EXPECT_THROW(KeyframeRelighter(device(), std::vector<HarmonicTransfer>{}), UsageError);
  EXPECT_THROW(
      KeyframeRelighter(device(), std::vector<HarmonicTransfer>{randomTransfer(2, 3), randomTransfer(3, 3)}),
      UsageError);
}

TEST(ClusterRelighter, EveryForm_AgreesWithDoubleReference) {
  for (const int channels : {1, 3}) {
    const HarmonicTransfer transfer = randomTransfer(4, channels);
    const auto light = randomLight(16, 7);
    for (const char* method :
         {"pca:1:float", "pca:7", "vq:20", "cpca:5:8", "cpca:9:3:byte", "cpca:300:2", "pca:16:byte"}) {
      const CompressedTransfer compressed = compress(transfer, parseCompression(method));
      ClusterRelighter relighter(device(), compressed);
      relighter.setLight(light);
      Buffer<float> radiance(device(), 3 * vertexCount);
      relighter.relight(radiance);
      SCOPED_TRACE(method);
      expectNear(radiance, relight(decompress(compressed), light), 1e-5);
    }
  }
}

HaarTransfer randomHaar(std::size_t vertices, int faceSize, int channels, double density) {
  std::mt19937 random(8);
  HaarTransfer transfer;
  transfer.faceSize = faceSize;
  transfer.channels = channels;
  transfer.offsets = {0};
  const auto texels = static_cast<std::uint32_t>(6 * faceSize * faceSize);
  for (std::size_t row = 0; row < vertices * static_cast<std::size_t>(channels); ++row) {
    for (std::uint32_t i = 0; i < texels; ++i)
      if (std::uniform_real_distribution<double>(0, 1)(random) < density) {
        transfer.indices.push_back(i);
        transfer.values.push_back(std::uniform_real_distribution<float>(-1, 1)(random));
      }
    transfer.offsets.push_back(static_cast<std::uint32_t>(transfer.indices.size()));
  }
  return transfer;
}

TEST(HaarRelighter, BothForms_AgreeWithDoubleReference) {
  for (const int channels : {1, 3}) {
    constexpr std::size_t vertices = 1500;  // More than a block.
    const HaarTransfer transfer = randomHaar(vertices, 8, channels, 0.1);
    std::vector<haar::LitWavelet> light;
    std::mt19937 random(9);
    std::uniform_real_distribution<float> uniform(-1, 1);
    for (const std::uint32_t index : {383u, 0u, 17u, 64u, 128u, 301u})
      light.push_back({index, {uniform(random), uniform(random), uniform(random)}});
    const auto right = reference::relightHaar(transfer, light);
    for (const HaarForm form : {HaarForm::Columns, HaarForm::Rows}) {
      HaarRelighter relighter(device(), transfer, form);
      relighter.setLight(light);
      Buffer<float> radiance(device(), 3 * vertices);
      relighter.relight(radiance);
      expectNear(radiance, right, 1e-5);
      relighter.setLight({});
      relighter.relight(radiance);
      for (const float value : radiance.read()) ASSERT_EQ(value, 0.0f);
      EXPECT_THROW(relighter.setLight(std::vector<haar::LitWavelet>{{384u, {}}}), UsageError);
    }
  }
}

TEST(GlossyRelighter, LightAndLobe_AgreeWithDoubleReference) {
  for (const int order : {1, 3, 4})
    for (const int channels : {1, 3}) {
      const auto n = static_cast<std::size_t>(order * order);
      const GlossyTransfer transfer{
          order, channels, 0, randomFloats(vertexCount * static_cast<std::size_t>(channels) * n * n, 10)};
      const auto light = randomLight(n, 11);
      GlossyRelighter relighter(device(), transfer);
      relighter.light(light);
      const auto arriving = relighter.arriving();
      const auto right = reference::lightMatrices(transfer, light);
      ASSERT_EQ(arriving.size(), right.size());
      for (std::size_t i = 0; i < right.size(); ++i) ASSERT_NEAR(arriving[i], right[i], 1e-5) << i;

      std::mt19937 random(12);
      std::vector<glm::dvec3> directions;
      std::vector<float> flat;
      for (std::size_t v = 0; v < vertexCount; ++v) {
        const glm::vec3 d = test::randomDirection(random);
        directions.emplace_back(d);
        flat.insert(flat.end(), {d.x, d.y, d.z});
      }
      std::vector<double> lobe;
      for (int l = 0; l < order; ++l) lobe.push_back(1.0 / (1.0 + l));
      Buffer<float> directionBuffer(device(), std::span<const float>(flat));
      Buffer<float> radiance(device(), 3 * vertexCount);
      relighter.shade(directionBuffer, lobe, radiance);
      expectNear(radiance, reference::shadeGlossy(right, order, directions, lobe), 2e-5);
      EXPECT_THROW(relighter.light(std::vector<double>(1)), UsageError);
      EXPECT_THROW(relighter.shade(directionBuffer, std::vector<double>(9), radiance), UsageError);
    }
}

}  // namespace
}  // namespace prelight
