#include "export/map_picture.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace prelight {
namespace {

Picture pictureOf(int width, int height, const glm::vec3& value) {
  return {width, height,
          std::vector<glm::vec3>(static_cast<std::size_t>(width) * static_cast<std::size_t>(height), value)};
}

TEST(FilledTexels, OneKnownTexel_FillsAll) {
  Picture picture = pictureOf(7, 5, {-9, -9, -9});
  std::vector<bool> filled(35, false);
  picture.pixels[17] = {1, 2, 3};
  filled[17] = true;
  fillEmptyTexels(picture, filled);
  for (const glm::vec3& pixel : picture.pixels) EXPECT_EQ(pixel, glm::vec3(1, 2, 3));
}

TEST(FilledTexels, KnownTexels_StayAsTheyAre) {
  Picture picture = pictureOf(8, 8, glm::vec3(0));
  std::vector<bool> filled(64, false);
  for (std::size_t i = 0; i < 64; i += 3) {
    picture.pixels[i] = glm::vec3(static_cast<float>(i));
    filled[i] = true;
  }
  const Picture before = picture;
  fillEmptyTexels(picture, filled);
  for (std::size_t i = 0; i < 64; i += 3) EXPECT_EQ(picture.pixels[i], before.pixels[i]) << i;
}

/// Each half has its own colour: an empty texel takes the colour of the nearest known one, not of the other
/// half.
TEST(FilledTexels, EmptyTexels_TakeAfterTheNearest) {
  Picture picture = pictureOf(16, 4, glm::vec3(0));
  std::vector<bool> filled(64, false);
  for (std::size_t y = 0; y < 4; ++y)
    for (const std::size_t x : {0u, 1u, 14u, 15u}) {
      filled[16 * y + x] = true;
      picture.pixels[16 * y + x] = glm::vec3(x < 8 ? 1.0f : 3.0f);
    }
  fillEmptyTexels(picture, filled);
  for (std::size_t y = 0; y < 4; ++y) {
    EXPECT_EQ(picture.pixels[16 * y + 3], glm::vec3(1.0f));
    EXPECT_EQ(picture.pixels[16 * y + 12], glm::vec3(3.0f));
  }
}

TEST(FilledTexels, NothingKnown_ChangesNothing) {
  Picture picture = pictureOf(4, 4, {5, 5, 5});
  fillEmptyTexels(picture, std::vector<bool>(16, false));
  EXPECT_EQ(picture.pixels[3], glm::vec3(5, 5, 5));
}

TEST(OcclusionPicture, Texels_AreWithinZeroAndOneAndFilled) {
  LightMap map;
  map.layout.width = 3;
  map.layout.height = 1;
  map.layout.texels = {{0, 0, 0.5f, 0.25f}, {1, 0, 0.25f, 0.25f}};
  map.values = {0.6f, 0.6f, 0.6f, 1.01f, 1.01f, 1.01f, 0.0f, 0.0f, 0.0f};
  const Picture picture = occlusionPicture(map);
  EXPECT_EQ(picture.pixels[0], glm::vec3(0.6f));
  EXPECT_EQ(picture.pixels[1], glm::vec3(1.0f));
  EXPECT_GT(picture.pixels[2].x, 0.5f) << "an empty texel is filled";
}

}  // namespace
}  // namespace prelight
