#include "fit/texel_fill.h"

#include <gtest/gtest.h>

#include <vector>

namespace prelight {
namespace {

TEST(FillTexels, OneTexel_SpreadsEverywhere) {
  std::vector<std::uint8_t> filled(20, 0);
  std::vector<float> values(40, -9.0f);
  filled[7] = 1;
  values[14] = 3.0f;
  values[15] = 5.0f;
  fillTexels(5, 4, 2, filled, values);
  for (std::size_t texel = 0; texel < 20; ++texel) {
    EXPECT_EQ(filled[texel], 1);
    EXPECT_EQ(values[2 * texel], 3.0f);
    EXPECT_EQ(values[2 * texel + 1], 5.0f);
  }
}

TEST(FillTexels, Neighbours_AreAveragedAndKept) {
  std::vector<std::uint8_t> filled = {1, 0, 1};
  std::vector<float> values = {2.0f, 100.0f, 4.0f};
  fillTexels(3, 1, 1, filled, values);
  EXPECT_EQ(values, (std::vector<float>{2.0f, 3.0f, 4.0f}));
}

// Two texels that are filled in the same ring must not use each other's value.
TEST(FillTexels, Ring_TakesOnlyWhatWasThere) {
  std::vector<std::uint8_t> filled = {0, 1, 0, 0};
  std::vector<float> values = {0.0f, 8.0f, 50.0f, 70.0f};
  fillTexels(2, 2, 1, filled, values);
  EXPECT_EQ(values, (std::vector<float>{8.0f, 8.0f, 8.0f, 8.0f}));
}

TEST(FillTexels, NothingFilled_StaysAsItIs) {
  std::vector<std::uint8_t> filled(4, 0);
  std::vector<float> values = {1, 2, 3, 4};
  fillTexels(2, 2, 1, filled, values);
  EXPECT_EQ(values, (std::vector<float>{1, 2, 3, 4}));
  EXPECT_EQ(filled, std::vector<std::uint8_t>(4, 0));
}

// Three groups of texels in a row; the third group has no filled texel to copy.
TEST(FillTexels, Groups_TakeAfterTheirOwn) {
  std::vector<std::uint8_t> filled = {1, 0, 0, 0, 1, 0};
  std::vector<float> values = {2.0f, 50.0f, 50.0f, 50.0f, 6.0f, 50.0f};
  const std::vector<std::uint32_t> groups = {7, 7, 7, 9, 9, 1};
  fillTexels(6, 1, 1, filled, values, groups);
  EXPECT_EQ(values, (std::vector<float>{2.0f, 2.0f, 2.0f, 6.0f, 6.0f, 50.0f}));
  EXPECT_EQ(filled, (std::vector<std::uint8_t>{1, 1, 1, 1, 1, 0}));
}

}  // namespace
}  // namespace prelight
