// Light of single samples that is spread over the pixels around.
#include "integrators/spread_specks.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <vector>

namespace prelight::test {
namespace {

constexpr int side = 21;
constexpr std::size_t middle = 10 * side + 10;

Picture evenPicture(const glm::vec3& radiance) {
  return {side, side, std::vector<glm::vec3>(std::size_t{side} * side, radiance)};
}

std::vector<float> noExcess() { return std::vector<float>(std::size_t{side} * side, 0.0f); }

glm::dvec3 sumOf(const std::vector<glm::vec3>& pixels) {
  glm::dvec3 sum(0.0);
  for (const glm::vec3& pixel : pixels) sum += glm::dvec3(pixel);
  return sum;
}

TEST(SpreadSpecks, BrightSample_IsSharedOut_AndTheSumStays) {
  const glm::vec3 around(0.2f, 0.1f, 0.05f);
  Picture picture = evenPicture(around);
  picture.pixels[middle] = glm::vec3(5.0f);
  std::vector<float> excess = noExcess();
  excess[middle] = 4.9f;
  const glm::dvec3 before = sumOf(picture.pixels);
  spreadSpecks(excess, picture, {});
  EXPECT_LT(picture.pixels[middle].y, 3.0f * around.y);
  EXPECT_GT(picture.pixels[middle + 1].y, around.y);
  EXPECT_EQ(picture.pixels[0], around);  // out of reach
  const glm::dvec3 after = sumOf(picture.pixels);
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(after[c], before[c], 1e-5 * before[c]);
}

TEST(SpreadSpecks, SharedLight_FollowsTheColoursAround) {
  Picture picture = evenPicture(glm::vec3(0.1f));
  for (std::size_t i = 0; i < middle; ++i) picture.pixels[i] = glm::vec3(0.02f, 0.02f, 0.06f);
  const std::vector<glm::vec3> plain = picture.pixels;
  picture.pixels[middle] = glm::vec3(4.0f);
  std::vector<float> excess = noExcess();
  excess[middle] = 3.9f;
  spreadSpecks(excess, picture, {});
  const glm::vec3 dark = picture.pixels[middle - side] / plain[middle - side],
                  light = picture.pixels[middle + side] / plain[middle + side];
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(dark[c], light[c], 1e-3f * light[c]) << c;
  EXPECT_GT(light.y, 1.1f);
}

TEST(SpreadSpecks, BrightPixelWhoseSamplesAgree_Stays) {
  Picture picture = evenPicture(glm::vec3(0.1f));
  picture.pixels[middle] = glm::vec3(5.0f);
  std::vector<float> excess = noExcess();
  excess[middle] = 0.5f;
  const std::vector<glm::vec3> before = picture.pixels;
  spreadSpecks(excess, picture, {});
  EXPECT_EQ(picture.pixels, before);
}

/// A pixel at the edge of a bright area, an eighth of which covers it, is no speck: its antialiasing stays.
TEST(SpreadSpecks, EdgeOfABrightArea_Stays) {
  Picture picture = evenPicture(glm::vec3(0.1f));
  std::vector<float> excess = noExcess();
  for (int y = 0; y < side; ++y)
    for (int x = 0; x <= 10; ++x) {
      const auto i = static_cast<std::size_t>(y * side + x);
      picture.pixels[i] = glm::vec3(x < 10 ? 8.0f : 1.1f);
      if (x == 10) excess[i] = 1.0f;
    }
  const std::vector<glm::vec3> before = picture.pixels;
  spreadSpecks(excess, picture, {});
  EXPECT_EQ(picture.pixels, before);
}

TEST(SpreadSpecks, Parts_StillSumUpToThePicture) {
  Picture picture = evenPicture(glm::vec3(0.1f));
  picture.pixels[middle] = glm::vec3(5.0f, 3.0f, 2.0f);
  std::vector<PartPicture> parts(2);
  for (const glm::vec3& pixel : picture.pixels) {
    parts[0].pixels.push_back(0.25f * pixel);
    parts[1].pixels.push_back(0.75f * pixel);
  }
  std::vector<float> excess = noExcess();
  excess[middle] = 3.0f;
  spreadSpecks(excess, picture, parts);
  for (std::size_t i = 0; i < picture.pixels.size(); ++i)
    for (int c = 0; c < 3; ++c)
      ASSERT_NEAR(parts[0].pixels[i][c] + parts[1].pixels[i][c], picture.pixels[i][c], 1e-6f) << i;
  EXPECT_LT(picture.pixels[middle].x, 1.0f);
}

TEST(SpreadSpecks, SpeckInTheDark_KeepsItsLight) {
  Picture picture = evenPicture(glm::vec3(0.0f));
  picture.pixels[middle] = glm::vec3(1.0f);
  std::vector<float> excess = noExcess();
  excess[middle] = 1.0f;
  spreadSpecks(excess, picture, {});
  EXPECT_EQ(picture.pixels[middle], glm::vec3(1.0f));
}

}  // namespace
}  // namespace prelight::test
