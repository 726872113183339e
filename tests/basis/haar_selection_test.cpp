#include "basis/haar.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "benchmarks/lab/wavelet_trials.h"
#include "prelight/error.h"

namespace prelight {
namespace {

using testing::ElementsAre;

/// Coefficients over many orders of magnitude; some are equal and some are 0.
std::vector<float> randomCoefficients(std::size_t count) {
  std::mt19937 random(4);
  std::normal_distribution<double> normal;
  std::vector<float> values(count);
  for (std::size_t i = 0; i < count; ++i) {
    values[i] = static_cast<float>(normal(random) * std::exp(4.0 * normal(random)));
    if (i % 7 == 0) values[i] = 0.0f;
    if (i % 11 == 0) values[i] = 0.25f;
  }
  return values;
}

double squares(std::span<const float> values) {
  double sum = 0.0;
  for (const float value : values) sum += double(value) * double(value);
  return sum;
}

TEST(HaarSelection, KeepError_AnyBound_IsKeptWithTheFewestCoefficients) {
  const std::vector<float> all = randomCoefficients(20000);
  std::vector<float> sorted = all;
  std::sort(sorted.begin(), sorted.end(), [](float a, float b) { return std::abs(a) > std::abs(b); });
  for (const double error : {0.3, 0.1, 0.01, 1e-4}) {
    const haar::SparseRow row = haar::keepError(all, error);
    const double total = squares(all), kept = squares(row.values);
    EXPECT_LE(total - kept, error * error * total * (1.0 + 1e-9)) << error;
    EXPECT_TRUE(std::is_sorted(row.indices.begin(), row.indices.end()));
    // Dropping every coefficient of the smallest kept magnitude would have exceeded the permitted error.
    const float least = *std::min_element(row.values.begin(), row.values.end(),
                                          [](float a, float b) { return std::abs(a) < std::abs(b); });
    const auto equals = std::count_if(row.values.begin(), row.values.end(),
                                      [&](float v) { return std::abs(v) == std::abs(least); });
    EXPECT_GT(total - kept + static_cast<double>(equals) * least * least, error * error * total) << error;
    for (std::size_t k = 0; k < row.indices.size(); ++k) ASSERT_EQ(row.values[k], all[row.indices[k]]);
    EXPECT_EQ(std::abs(least), std::abs(sorted[row.values.size() - 1]));
  }
}

TEST(HaarSelection, KeepError_OfZero_KeepsWhatIsNotZero) {
  const std::vector<float> all = randomCoefficients(1000);
  const auto expected = std::count_if(all.begin(), all.end(), [](float v) { return v != 0.0f; });
  EXPECT_EQ(haar::keepError(all, 0.0).values.size(), static_cast<std::size_t>(expected));
  EXPECT_TRUE(haar::keepError(std::vector<float>(64, 0.0f), 0.0).indices.empty());
  EXPECT_TRUE(haar::keepError(std::vector<float>(64, 0.0f), 0.5).indices.empty());
}

TEST(HaarSelection, AreaWeights_AreIntegralsOfMagnitudes) {
  constexpr int size = 8;
  const CubeTexels texels(size);
  const std::vector<float> weights = haar::areaWeights(size);
  for (std::uint32_t i = 0; i < texels.count(); ++i) {
    const haar::Wavelet wavelet = haar::waveletOf(i, size);
    double sum = 0.0;
    for (int row = 0; row < size; ++row) {
      for (int column = 0; column < size; ++column) {
        const auto texel = static_cast<std::uint32_t>((wavelet.face * size + row) * size + column);
        sum += texels.solidAngle(texel) * std::abs(haar::valueAt(wavelet, row, column));
      }
    }
    ASSERT_NEAR(weights[i], sum, 1e-6 * sum) << i;
  }
}

TEST(HaarSelection, TransformLight_IsTheTransformOfEachChannel) {
  CubeMap map{4, std::vector<glm::vec3>(96)};
  for (std::size_t i = 0; i < 96; ++i) map.radiance[i] = {float(i), 1.0f, float(i % 5)};
  const std::vector<float> light = haar::transformLight(map);
  ASSERT_EQ(light.size(), 3u * 96u);
  for (int c = 0; c < 3; ++c) {
    std::vector<float> channel(96);
    for (std::size_t i = 0; i < 96; ++i) channel[i] = map.radiance[i][c];
    haar::forward(std::span<float>(channel), 4);
    for (std::size_t i = 0; i < 96; ++i) ASSERT_EQ(light[static_cast<std::size_t>(c) * 96 + i], channel[i]);
  }
  map.radiance[3].x = -1.0f;
  EXPECT_THROW(haar::transformLight(map), InputError);
}

/// Repeats values of light for three equal channels.
std::vector<float> grey(const std::vector<float>& values) {
  std::vector<float> light;
  for (int c = 0; c < 3; ++c) light.insert(light.end(), values.begin(), values.end());
  return light;
}

TEST(HaarSelection, SelectLight_RanksByChannelsTogetherTimesWeight) {
  std::vector<float> light = {1, 0, 0, 2, 0,  0,   // R
                              1, 3, 0, 0, 0,  0,   // G
                              1, 0, 0, 0, -9, 0};  // B
  EXPECT_THAT(haar::selectLight(light, std::vector<float>(6, 1.0f), 2).indices, ElementsAre(1, 4));
  const haar::SparseLight selection = haar::selectLight(light, std::vector<float>{2, 1, 1, 1, 0.1f, 1}, 2);
  EXPECT_THAT(selection.indices, ElementsAre(0, 1));
  EXPECT_EQ(selection.values[0], glm::vec3(1.0f));
  EXPECT_EQ(selection.values[1], glm::vec3(0.0f, 3.0f, 0.0f));
}

TEST(HaarSelection, SelectSoftly_WhenRanksSwap_ChangesNothingAtOnce) {
  const std::vector<float> weights(6, 1.0f);
  const auto valueOf = [](const haar::SparseLight& part, std::uint32_t i) {
    for (std::size_t k = 0; k < part.indices.size(); ++k) {
      if (part.indices[k] == i) return part.values[k].x;
    }
    return 0.0f;
  };
  const auto before = grey({10.0f, 3.0001f, 3.0f, 0.0f, 0.0f, 0.0f}),
             after = grey({10.0f, 3.0f, 3.0001f, 0, 0, 0});
  const haar::SparseLight softBefore = haar::selectLightSoftly(before, weights, 2, 2.0f);
  const haar::SparseLight softAfter = haar::selectLightSoftly(after, weights, 2, 2.0f);
  for (std::uint32_t i = 0; i < 6; ++i)
    EXPECT_NEAR(valueOf(softBefore, i), valueOf(softAfter, i), 1e-3f) << i;
  EXPECT_EQ(valueOf(softBefore, 0), 10.0f);  // Far above the part that is left out.
  EXPECT_EQ(valueOf(haar::selectLight(before, weights, 2), 1), 3.0001f);
  EXPECT_EQ(valueOf(haar::selectLight(after, weights, 2), 1), 0.0f);
}

TEST(HaarSelection, Steady_KeepsWhatIsInAndFadesWhatGoes) {
  const std::vector<float> weights(6, 1.0f);
  haar::SteadySelection selection(1, 0.5f, 4);
  EXPECT_THAT(selection.next(grey({2.0f, 1.0f, 0, 0, 0, 0}), weights).indices, ElementsAre(0));
  EXPECT_THAT(selection.next(grey({2.0f, 2.5f, 0, 0, 0, 0}), weights).indices, ElementsAre(0));
  haar::SparseLight part = selection.next(grey({2.0f, 4.0f, 0, 0, 0, 0}), weights);
  EXPECT_THAT(part.indices, ElementsAre(0, 1));
  EXPECT_FLOAT_EQ(part.values[0].x, 1.5f);
  EXPECT_FLOAT_EQ(part.values[1].x, 1.0f);
  for (int frame = 0; frame < 3; ++frame) part = selection.next(grey({2.0f, 4.0f, 0, 0, 0, 0}), weights);
  EXPECT_THAT(part.indices, ElementsAre(1));
  EXPECT_FLOAT_EQ(part.values[0].x, 4.0f);
}

TEST(HaarSelection, ExpectedError_IsTheWeightedShareThatIsMissing) {
  const auto light = grey({3.0f, 4.0f, 0.0f, 0.0f, 0.0f, 0.0f});
  const std::vector<float> weights = {2.0f, 1.0f, 1.0f, 1.0f, 1.0f, 1.0f};
  EXPECT_DOUBLE_EQ(haar::expectedError(light, {}, weights), 1.0);
  EXPECT_NEAR(haar::expectedError(light, haar::selectLight(light, weights, 1), weights),
              4.0 / std::sqrt(52.0), 1e-12);
  EXPECT_EQ(haar::expectedError(light, haar::selectLight(light, weights, 2), weights), 0.0);
}

}  // namespace
}  // namespace prelight
