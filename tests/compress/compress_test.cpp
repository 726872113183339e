#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include "basis/sh.h"
#include "compress/compress.h"
#include "compress/compression_error.h"
#include "prelight/error.h"
#include "relight/device/compressed_light.h"

namespace prelight {
namespace {

using ::testing::HasSubstr;

/// Transfer that resembles a bake: open transfer about random normals, each channel dimmed and tilted in its
/// own way.
HarmonicTransfer someTransfer(std::size_t vertices, int order, int channels, unsigned seed = 1) {
  std::mt19937 random(seed);
  std::normal_distribution<double> normal;
  const auto n = static_cast<std::size_t>(order * order);
  HarmonicTransfer transfer{order, channels, channels == 3 ? 2 : 0, {}};
  std::vector<double> values(n);
  for (std::size_t v = 0; v < vertices; ++v) {
    const glm::dvec3 axis = glm::normalize(glm::dvec3(normal(random), normal(random), normal(random)));
    for (int c = 0; c < channels; ++c) {
      sh::openTransfer(glm::normalize(axis + 0.1 * c), order, values);
      const double dim = std::uniform_real_distribution<double>(0.2, 1.0)(random);
      for (const double value : values) transfer.coefficients.push_back(static_cast<float>(dim * value));
    }
  }
  return transfer;
}

TEST(ByteRange, ValuesOnAGrid_AreExact) {
  std::vector<double> values, weights(256, 1.0);
  for (int i = 0; i < 256; ++i) values.push_back(-3.0 + 0.125 * i);
  const ByteRange range = fitByteRange(values, weights);
  for (const double value : values) EXPECT_DOUBLE_EQ(range.decode(range.encode(value)), value);
  const std::vector<double> same(10, 0.7);
  const ByteRange flat = fitByteRange(same, std::vector<double>(10, 1.0));
  EXPECT_FLOAT_EQ(static_cast<float>(flat.decode(flat.encode(0.7))), 0.7f);
}

TEST(ByteRange, Outlier_IsClippedWhenThatLowersTheError) {
  std::mt19937 random(2);
  std::normal_distribution<double> normal;
  std::vector<double> values, weights;
  for (int i = 0; i < 20000; ++i) {
    values.push_back(normal(random));
    weights.push_back(1.0);
  }
  const auto meanSquare = [&](const ByteRange& range) {
    double sum = 0.0;
    for (const double value : values) sum += std::pow(range.decode(range.encode(value)) - value, 2);
    return sum / double(values.size());
  };
  const auto [least, greatest] = std::minmax_element(values.begin(), values.end());
  const ByteRange whole{static_cast<float>(*least), static_cast<float>((*greatest - *least) / 255.0)};
  const ByteRange fitted = fitByteRange(values, weights);
  EXPECT_LE(meanSquare(fitted), meanSquare(whole));
  EXPECT_NEAR(std::sqrt(meanSquare(fitted)), fitted.scale / std::sqrt(12.0), 0.05 * fitted.scale);
}

class EveryMethod : public ::testing::TestWithParam<std::tuple<const char*, int>> {};

TEST_P(EveryMethod, LightOnCompressed_IsLightOnDecompressed) {
  const auto [name, channels] = GetParam();
  const HarmonicTransfer transfer = someTransfer(300, 4, channels);
  const CompressedTransfer compressed = compress(transfer, parseCompression(name));
  const HarmonicTransfer restored = decompress(compressed);
  ASSERT_EQ(restored.coefficients.size(), transfer.coefficients.size());
  EXPECT_EQ(restored.bounces, transfer.bounces);
  for (const auto& light : testLights(4)) {
    const auto direct = relight(compressed, lightOf(compressed, light));
    const auto expected = relight(restored, light);
    for (std::size_t v = 0; v < direct.size(); ++v)
      for (int c = 0; c < 3; ++c) ASSERT_NEAR(direct[v][c], expected[v][c], 3e-6) << name << " vertex " << v;
  }
}

TEST_P(EveryMethod, CompressedTransfer_IsSmallerAndTheSameEachTime) {
  const auto [name, channels] = GetParam();
  const HarmonicTransfer transfer = someTransfer(2000, 4, channels);
  const CompressedTransfer compressed = compress(transfer, parseCompression(name));
  EXPECT_LT(compressed.byteCount(), transfer.coefficients.size() * sizeof(float));
  EXPECT_EQ(decompress(compressed).coefficients,
            decompress(compress(transfer, parseCompression(name))).coefficients);
}

INSTANTIATE_TEST_SUITE_P(Methods, EveryMethod,
                         ::testing::Combine(::testing::Values("half", "band8", "rgbe", "pca:9", "pca:9:byte",
                                                              "vq:64", "cpca:16:4", "cpca:16:4:float",
                                                              "cpca:16:4:byte"),
                                            ::testing::Values(1, 3)));

double squaredErrorOf(const HarmonicTransfer& transfer, const char* name) {
  return compressionError(transfer, decompress(compress(transfer, parseCompression(name)))).squared;
}

TEST(Compress, Half_IsTheNearestHalf) {
  const HarmonicTransfer transfer = someTransfer(500, 5, 3);
  const auto restored = decompress(compress(transfer, parseCompression("half"))).coefficients;
  for (std::size_t i = 0; i < restored.size(); ++i)
    ASSERT_LE(std::abs(restored[i] - transfer.coefficients[i]),
              std::max(std::abs(transfer.coefficients[i]) * 0x1p-11f, 0x1p-25f));
}

TEST(Compress, Band8_ErrsLessThanHalfAStepOfTheWholeRange) {
  const HarmonicTransfer transfer = someTransfer(500, 5, 3);
  const auto restored = decompress(compress(transfer, parseCompression("band8"))).coefficients;
  for (int channel = 0; channel < 3; ++channel)
    for (int band = 0; band < 5; ++band) {
      double least = 1e9, greatest = -1e9, squares = 0.0, count = 0.0;
      for (int v = 0; v < 500; ++v)
        for (int i = band * band; i < (band + 1) * (band + 1); ++i) {
          const auto at = static_cast<std::size_t>((v * 3 + channel) * 25 + i);
          least = std::min<double>(least, transfer.coefficients[at]);
          greatest = std::max<double>(greatest, transfer.coefficients[at]);
          squares += std::pow(double(restored[at]) - transfer.coefficients[at], 2);
          count += 1.0;
        }
      EXPECT_LE(std::sqrt(squares / count), (greatest - least) / 255.0 / 2.0 + 1e-8)
          << channel << ", " << band;
    }
}

TEST(Compress, Rgbe_ErrsByTheGreatestOfItsVertexAndBandAlone) {
  HarmonicTransfer transfer = someTransfer(500, 5, 3);
  // Vertices of very different brightness, which one range over all of them could not represent.
  for (std::size_t v = 0; v < 500; ++v)
    for (std::size_t i = 0; i < 75; ++i)
      transfer.coefficients[v * 75 + i] *= std::ldexp(1.0f, -static_cast<int>(v % 40));
  const auto restored = decompress(compress(transfer, parseCompression("rgbe"))).coefficients;
  int lit = 0;
  for (std::size_t v = 0; v < 500; ++v)
    for (std::size_t band = 0; band < 5; ++band) {
      float greatest = 0.0f, error = 0.0f;
      for (std::size_t c = 0; c < 3; ++c)
        for (std::size_t i = band * band; i < (band + 1) * (band + 1); ++i) {
          const std::size_t at = v * 75 + c * 25 + i;
          greatest = std::max(greatest, std::abs(transfer.coefficients[at]));
          error = std::max(error, std::abs(restored[at] - transfer.coefficients[at]));
        }
      // Half a step of 1/128 of a power of two that is at most twice the greatest value; a whole step at the
      // range's end.
      ASSERT_LE(error, greatest * 0x1.03p-7f) << v << ", " << band;
      if (greatest > 0.0f) ++lit;
    }
  EXPECT_GT(lit, 1500);
}

TEST(CompressToError, RoundingOfWeights_CountsAsError) {
  // The second component has 1.99 % of the numbers' RMS: without it, and with bytes of the first one's
  // weights, the error is 2.03 %.
  constexpr std::size_t vertices = 4000;
  const double share = 0.0199;
  HarmonicTransfer transfer{2, 1, 0, {}};
  for (std::size_t v = 0; v < vertices; ++v) {
    const double along = 2.0 * (double(v) + 0.5) / vertices - 1.0;  // RMS 1 / sqrt(3)
    const double across = (v % 2 == 0 ? 1.0 : -1.0) * share / std::sqrt(3.0);
    for (const double value : {along, across, 0.0, 0.0})
      transfer.coefficients.push_back(static_cast<float>(value));
  }
  for (const auto& [bound, components] : {std::pair(0.02, 2), std::pair(0.021, 1), std::pair(1.1, 0)}) {
    const auto found = compressToError(transfer, bound, 4, {}, Progress());
    ASSERT_TRUE(found) << bound;
    EXPECT_EQ(found->transfer.components, components) << bound;
    const std::vector<float> stored = decompress(found->transfer).coefficients;
    double errors = 0.0, squares = 0.0;
    for (std::size_t i = 0; i < stored.size(); ++i) {
      errors += std::pow(double(stored[i]) - double(transfer.coefficients[i]), 2);
      squares += std::pow(double(transfer.coefficients[i]), 2);
    }
    EXPECT_NEAR(found->error, std::sqrt(errors / squares), 1e-9);
    EXPECT_LE(found->error, bound);
  }
  EXPECT_FALSE(compressToError(transfer, 0.02, 1, {}, Progress()));
}

TEST(Compress, RgbeOfZerosAndExtremes_IsFinite) {
  const HarmonicTransfer transfer{1, 1, 0, {0.0f, 1e-42f, 3e38f, -3e38f, 1.0f}};
  const auto restored = decompress(compress(transfer, parseCompression("rgbe"))).coefficients;
  EXPECT_EQ(restored[0], 0.0f);
  EXPECT_EQ(restored[1], 0.0f);
  EXPECT_NEAR(restored[2], 3e38f, 1.8e38f);
  EXPECT_NEAR(restored[3], -3e38f, 1.8e38f);
  EXPECT_EQ(restored[4], 1.0f);
}

TEST(Compress, WeightsOfFewerBits_CostLittle) {
  const HarmonicTransfer transfer = someTransfer(2000, 4, 3);
  const double whole = squaredErrorOf(transfer, "cpca:16:4:float");
  EXPECT_NEAR(squaredErrorOf(transfer, "cpca:16:4"), whole, 1e-4 * whole);
  EXPECT_NEAR(squaredErrorOf(transfer, "cpca:16:4:byte"), whole, 0.01 * whole);
  EXPECT_GT(squaredErrorOf(transfer, "cpca:16:4:byte"), whole);
}

TEST(Compress, ClusteredPca_BeatsBothOfItsParents) {
  const HarmonicTransfer transfer = someTransfer(2000, 4, 3);
  EXPECT_LT(squaredErrorOf(transfer, "cpca:16:4"), squaredErrorOf(transfer, "pca:4"));
  EXPECT_LT(squaredErrorOf(transfer, "cpca:16:4"), squaredErrorOf(transfer, "vq:16"));
}

TEST(Compress, AllComponents_RestoreTheTransfer) {
  const HarmonicTransfer transfer = someTransfer(200, 3, 3);
  const auto restored = decompress(compress(transfer, parseCompression("pca:27:float")));
  for (std::size_t i = 0; i < transfer.coefficients.size(); ++i)
    ASSERT_NEAR(restored.coefficients[i], transfer.coefficients[i], 1e-6);
}

TEST(Compress, ByteCount_IsTheSumOfWhatIsStored) {
  const HarmonicTransfer transfer = someTransfer(100, 3, 3);
  EXPECT_EQ(compress(transfer, parseCompression("half")).byteCount(), 100u * 27 * 2);
  EXPECT_EQ(compress(transfer, parseCompression("band8")).byteCount(), 100u * 27 + 3 * 3 * 2 * 4);
  EXPECT_EQ(compress(transfer, parseCompression("rgbe")).byteCount(), 100u * (27 + 3));
  EXPECT_EQ(compress(transfer, parseCompression("cpca:4:5")).byteCount(),
            4u * (1 + 5) * 27 * 4 + 100 * (2 + 5 * 2));
  EXPECT_EQ(compress(transfer, parseCompression("pca:5:byte")).byteCount(),
            (1u + 5) * 27 * 4 + 100 * 5 + 5 * 2 * 4);
}

TEST(Compress, HalfBeyondItsRange_Saturates) {
  const HarmonicTransfer transfer{1, 1, 0, {1e6f, -1e6f, 1.0f}};
  EXPECT_EQ(decompress(compress(transfer, parseCompression("half"))).coefficients,
            (std::vector<float>{65504.0f, -65504.0f, 1.0f}));
}

TEST(Compress, EmptyScene_IsEmpty) {
  const HarmonicTransfer transfer{3, 3, 0, {}};
  for (const char* name : {"half", "band8", "rgbe", "pca:2", "vq:4", "cpca:4:2"})
    EXPECT_TRUE(decompress(compress(transfer, parseCompression(name))).coefficients.empty()) << name;
}

TEST(Compress, BadInput_IsNamed) {
  HarmonicTransfer transfer = someTransfer(10, 2, 1);
  EXPECT_THROW(compress(transfer, parseCompression("pca:5")), UsageError);
  transfer.coefficients[3] = std::numeric_limits<float>::quiet_NaN();
  EXPECT_THROW(compress(transfer, parseCompression("half")), InputError);
  transfer.coefficients.pop_back();
  EXPECT_THROW(compress(transfer, parseCompression("half")), InputError);
  const auto compressed = compress(someTransfer(10, 2, 1), parseCompression("half"));
  EXPECT_THROW(lightOf(compressed, std::vector<double>(5)), UsageError);
}

TEST(ParseCompression, Names_ComeBack) {
  for (const char* name :
       {"half", "band8", "rgbe", "pca:12", "vq:256", "cpca:64:8", "cpca:64:8:float", "pca:3:byte"})
    EXPECT_EQ(compressionName(parseCompression(name)), name);
  EXPECT_EQ(compressionName(parseCompression("cpca:2:3:half")), "cpca:2:3");
}

TEST(ParseCompression, Nonsense_SaysWhatIsExpected) {
  for (const char* name : {"", "zip", "pca", "pca:", "pca:0", "pca:x", "pca:3:", "vq:-1", "vq:70000",
                           "vq:4:half", "cpca:4", "cpca:4:2:double", "half:2", "cpca:4:2:half:1"})
    try {
      parseCompression(name);
      ADD_FAILURE() << name << " was taken";
    } catch (const UsageError& error) {
      EXPECT_THAT(error.what(), HasSubstr("cpca:N:K")) << name;
    }
}

TEST(CompressionError, KnownDifference_IsReported) {
  const HarmonicTransfer original{1, 1, 0, {1.0f, 1.0f}}, restored{1, 1, 0, {1.1f, 1.0f}};
  const std::vector<double> weights = {3.0, 1.0};
  const CompressionError error = compressionError(original, restored, weights);
  EXPECT_NEAR(error.squared, 0.03, 1e-7);
  EXPECT_NEAR(error.vectorRms, std::sqrt(0.03 / 4.0), 1e-7);
  EXPECT_NEAR(error.lightingRms, std::sqrt(0.03 / 4.0), 1e-7);
}

}  // namespace
}  // namespace prelight
