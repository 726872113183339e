#include "compress/quantized_numbers.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "compress/small_floats.h"

namespace prelight {
namespace {

std::vector<float> numbersBetween(float least, float most, std::size_t count) {
  std::mt19937 random(7);
  std::uniform_real_distribution<float> distribution(least, most);
  std::vector<float> numbers(count);
  for (float& number : numbers) number = distribution(random);
  return numbers;
}

std::vector<float> decoded(std::span<const float> numbers, const ByteForm& form,
                           std::span<const std::uint32_t> ends = {}) {
  return dequantize(quantize(numbers, form, ends).value(), ends);
}

/// Returns half a step around a number: half of 1 / levels, or for squares half of the greater of the two
/// differences of neighbours' squares.
double halfStep(double share, double levels, bool square) {
  if (!square) return 0.5 / levels;
  const double t = std::sqrt(std::abs(share)) + 0.5 / levels;
  return t / levels;  // ((t + h)^2 - (t - h)^2) / 2 with h = 0.5 / levels
}

struct FormCase {
  const char* name;
  ByteForm form;
};

class EveryForm : public testing::TestWithParam<FormCase> {};

TEST_P(EveryForm, Error_IsAtMostHalfAStep) {
  const ByteForm& form = GetParam().form;
  const double levels = form.isSigned ? 127.0 : 255.0;
  const std::vector<float> numbers = numbersBetween(form.isSigned ? -form.scale : 0.0f, form.scale, 4096);
  const QuantizedNumbers quantized = quantize(numbers, form).value();
  const std::vector<float> restored = dequantize(quantized);
  ASSERT_EQ(restored.size(), numbers.size());
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    const double scale = form.group == 0 ? form.scale : fromHalf(quantized.scales[i / form.group]);
    const double most = scale * halfStep(numbers[i] / scale, levels, form.square);
    EXPECT_NEAR(restored[i], numbers[i], most * (1.0 + 1e-6)) << i;
  }
}

TEST_P(EveryForm, EndsOfTheRangeAndZero_AreExact) {
  ByteForm form = GetParam().form;
  form.group = 0;
  const std::vector<float> numbers = {0.0f, form.scale, form.isSigned ? -form.scale : 0.0f};
  EXPECT_EQ(decoded(numbers, form), numbers);
}

TEST_P(EveryForm, DecodedNumbers_AreEncodedToThemselves) {
  ByteForm form = GetParam().form;
  form.group = 0;
  const QuantizedNumbers once =
      quantize(numbersBetween(form.isSigned ? -form.scale : 0.0f, form.scale, 1000), form).value();
  EXPECT_EQ(quantize(dequantize(once), form)->bytes, once.bytes);
}

INSTANTIATE_TEST_SUITE_P(Table, EveryForm,
                         testing::Values(FormCase{"Signed", {}},
                                         FormCase{"SignedSquare", {.square = true, .scale = 2.5f}},
                                         FormCase{"Unsigned", {.isSigned = false, .scale = 1.5707964f}},
                                         FormCase{"UnsignedSquare", {.isSigned = false, .square = true}},
                                         FormCase{"Groups", {.group = 16}},
                                         FormCase{"SquareGroups", {.square = true, .group = 8}}),
                         [](const auto& instance) { return std::string(instance.param.name); });

TEST(QuantizedNumbers, SmallGroupsBesideLargeOnes_KeepTheirPrecision) {
  const std::vector<float> numbers = {1000.0f, -250.0f, 1e-3f, -2.5e-4f, 0.0f, 0.0f};
  const std::vector<float> restored = decoded(numbers, {.group = 2});
  for (std::size_t i = 0; i < 4; ++i)
    EXPECT_NEAR(restored[i], numbers[i], std::abs(numbers[i / 2 * 2]) * 0.005) << i;
  EXPECT_EQ(restored[4], 0.0f);
}

TEST(QuantizedNumbers, Scale_IsTheLeastHalfThatHoldsTheGroup) {
  for (const float greatest : {1.0f, 0.3333333f, 6.1e-5f, 3e-8f, 65503.9f, 65504.0f}) {
    const std::vector<float> numbers = {greatest, 0.0f};
    const std::uint16_t scale = quantize(numbers, {.group = 2})->scales.at(0);
    EXPECT_GE(fromHalf(scale), greatest);
    EXPECT_LT(fromHalf(static_cast<std::uint16_t>(scale - 1)), greatest);
  }
}

TEST(QuantizedNumbers, BeyondTheRange_Saturate) {
  EXPECT_EQ(decoded(std::vector{-0.5f, 1.5f}, {.isSigned = false}), (std::vector{0.0f, 1.0f}));
  EXPECT_EQ(decoded(std::vector{-3.0f, 3.0f}, {}), (std::vector{-1.0f, 1.0f}));
}

TEST(QuantizedNumbers, ThatAreNotFiniteOrBeyondHalves_AreLeftAlone) {
  const float infinite = std::numeric_limits<float>::infinity(), none = std::nanf("");
  for (const float bad : {infinite, -infinite, none}) {
    EXPECT_FALSE(quantize(std::vector{0.0f, bad}, {}));
    EXPECT_FALSE(quantize(std::vector{0.0f, bad}, {.group = 2}));
  }
  EXPECT_FALSE(quantize(std::vector{70000.0f}, {.group = 1}));
}

TEST(QuantizedNumbers, RowsOfManyLengths_HaveAScaleEach) {
  const std::vector<std::uint32_t> ends = {0, 3, 3, 4};
  const std::vector<float> numbers = {8.0f, -8.0f, 4.0f, 1e-2f};
  const QuantizedNumbers quantized = quantize(numbers, {}, ends).value();
  ASSERT_EQ(quantized.scales.size(), 4u);
  EXPECT_EQ(fromHalf(quantized.scales[0]), 0.0f);
  EXPECT_EQ(fromHalf(quantized.scales[1]), 8.0f);
  const std::vector<float> restored = dequantize(quantized, ends);
  EXPECT_EQ(restored[0], 8.0f);
  EXPECT_EQ(restored[1], -8.0f);
  EXPECT_NEAR(restored[2], 4.0, 0.5 * 8.0 / 127.0);
  EXPECT_EQ(restored[3], fromHalf(quantized.scales[3]));
}

TEST(IndexGaps, EncodeDecode_GivesIndicesBack) {
  const std::vector<std::uint32_t> indices = {0, 1, 254, 255, 510, 6000, 255, 1000000, 3};
  const std::vector<std::uint32_t> ends = {6, 6, 8, 9};
  const std::vector<std::uint8_t> gaps = encodeGaps(indices, ends);
  EXPECT_EQ(decodeGaps(gaps, ends), indices);
  // 0, 1, 253, 1, 255 (in two bytes), 5490 (21 x 255 + 135), ...
  EXPECT_EQ(std::vector<std::uint8_t>(gaps.begin(), gaps.begin() + 6),
            (std::vector<std::uint8_t>{0, 1, 253, 1, 255, 0}));
}

TEST(IndexGaps, TruncatedOrTooMany_AreRefused) {
  const std::vector<std::uint32_t> indices = {7, 300, 301}, ends = {2, 3};
  const std::vector<std::uint8_t> gaps = encodeGaps(indices, ends);
  for (std::size_t length = 0; length < gaps.size(); ++length)
    EXPECT_FALSE(decodeGaps(std::span(gaps).first(length), ends)) << length;
  std::vector<std::uint8_t> more = gaps;
  more.push_back(0);
  EXPECT_FALSE(decodeGaps(more, ends));
  more.back() = 255;
  EXPECT_FALSE(decodeGaps(more, ends));
}

}  // namespace
}  // namespace prelight
