// Files of measured BRDFs: which are read, and which are refused.
#include "scene/codecs/merl_brdf.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <limits>

#include "prelight/error.h"
#include "support/merl_files.h"

namespace prelight {
namespace {

using testing::HasSubstr;

const std::vector<std::uint8_t>& plainFile() {
  static const std::vector<std::uint8_t> file =
      test::merlFile([](const glm::dvec3& wo, const glm::dvec3& wi) { return glm::dvec3(wo.z, wi.z, 0.5); });
  return file;
}

std::vector<std::uint8_t> with(std::size_t byte, const auto& value) {
  std::vector<std::uint8_t> file = plainFile();
  std::memcpy(file.data() + byte, &value, sizeof(value));
  return file;
}

std::string refusalOf(const std::vector<std::uint8_t>& bytes) {
  try {
    parseMerlBrdf(bytes, "x.binary");
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(MerlBrdf, Values_AreThoseOfTheFileTimesTheirScales) {
  const std::vector<glm::vec3> values = parseMerlBrdf(plainFile(), "x.binary");
  const auto pairs = test::merlDirections();
  ASSERT_EQ(values.size(), pairs.size());
  for (std::size_t i = 0; i < values.size(); i += 97) {
    if (pairs[i].wo.z > 0.0 && pairs[i].wi.z > 0.0) {
      EXPECT_NEAR(double(values[i].x), pairs[i].wo.z, 1e-6);
      EXPECT_NEAR(double(values[i].y), pairs[i].wi.z, 1e-6);
      EXPECT_NEAR(double(values[i].z), 0.5, 1e-6);
    } else {
      EXPECT_EQ(values[i], glm::vec3(-1.0f));
    }
  }
}

TEST(MerlBrdf, AnotherHeader_IsRefused) {
  EXPECT_THAT(refusalOf(with(0, std::int32_t{91})), HasSubstr("91 x 90 x 180"));
  EXPECT_THAT(refusalOf(with(8, std::int32_t{-1})), HasSubstr("90 x 90 x -1"));
}

TEST(MerlBrdf, AnotherLength_IsRefused) {
  std::vector<std::uint8_t> file = plainFile();
  EXPECT_THAT(refusalOf({}), HasSubstr("got 0 bytes, expected 34992012"));
  EXPECT_THAT(refusalOf({file.begin(), file.begin() + 11}), HasSubstr("got 11 bytes"));
  file.pop_back();
  EXPECT_THAT(refusalOf(file), HasSubstr("got 34992011 bytes, expected 34992012"));
  file.resize(file.size() + 2);
  EXPECT_THAT(refusalOf(file), HasSubstr("got 34992013 bytes"));
}

TEST(MerlBrdf, WhatIsNoNumber_IsRefusedWithItsPlace) {
  constexpr std::size_t channel = std::size_t{90} * 90 * 180, cell = (3 * 90 + 5) * 180 + 7;
  const std::size_t byte = 12 + 8 * (channel + cell);
  for (const double value : {std::nan(""), std::numeric_limits<double>::infinity(),
                             -std::numeric_limits<double>::infinity(), 1e300})
    EXPECT_THAT(refusalOf(with(byte, value)),
                testing::AllOf(HasSubstr("green"), HasSubstr("half angle 3, difference angle 5, turn 7")));
}

TEST(MerlBrdf, NegativeValues_CountAsNotMeasured) {
  const std::vector<glm::vec3> values = parseMerlBrdf(with(12, -3.5), "x.binary");
  EXPECT_EQ(values[0].x, -1.0f);
  EXPECT_GT(values[0].y, 0.0f);
}

}  // namespace
}  // namespace prelight
