#include "export/half_ktx2.h"

#include <gtest/gtest.h>

#include <cstring>

#include "compress/small_floats.h"

namespace prelight {
namespace {

std::uint32_t wordAt(const std::vector<std::uint8_t>& bytes, std::size_t offset) {
  std::uint32_t word = 0;
  std::memcpy(&word, &bytes.at(offset + 3) - 3, 4);
  return word;
}

float texelOf(const std::vector<std::uint8_t>& file, std::size_t texel, std::size_t channel) {
  const std::size_t at = wordAt(file, 80) + 8 * texel + 2 * channel;
  return fromHalf(static_cast<std::uint16_t>(file[at] | file[at + 1] << 8));
}

TEST(HalfKtx2, Header_IsThatOfTheSpecification) {
  const std::vector<std::uint8_t> file = encodeHalfKtx2({3, 2, std::vector<glm::vec3>(6, glm::vec3(1))});
  EXPECT_EQ(std::string(file.begin() + 1, file.begin() + 7), "KTX 20");
  EXPECT_EQ(wordAt(file, 12), 97u) << "VK_FORMAT_R16G16B16A16_SFLOAT";
  EXPECT_EQ(wordAt(file, 16), 2u) << "bytes of a type";
  EXPECT_EQ(wordAt(file, 20), 3u);
  EXPECT_EQ(wordAt(file, 24), 2u);
  EXPECT_EQ(wordAt(file, 36), 1u) << "faces";
  EXPECT_EQ(wordAt(file, 40), 1u) << "levels";
  EXPECT_EQ(wordAt(file, wordAt(file, 48)), wordAt(file, 52)) << "the descriptor tells its own size";
  EXPECT_EQ(wordAt(file, 80) % 8, 0u) << "texels are aligned to their size";
  EXPECT_EQ(wordAt(file, 88), 6u * 8u);
  EXPECT_EQ(file.size(), wordAt(file, 80) + 48u);
}

TEST(HalfKtx2, Texels_AreHalvesRowByRow) {
  Picture picture{2, 2, {{0.5f, 1, 2}, {3, 4, 5}, {6, 7, 8}, {1e9f, 0, 0}}};
  const std::vector<std::uint8_t> file = encodeHalfKtx2(picture);
  for (std::size_t t = 0; t < 3; ++t)
    for (std::size_t c = 0; c < 3; ++c)
      EXPECT_EQ(texelOf(file, t, c), picture.pixels[t][static_cast<int>(c)]);
  EXPECT_EQ(texelOf(file, 0, 3), 1.0f);
  EXPECT_EQ(texelOf(file, 3, 0), halfMax) << "too bright is the brightest, not infinite";
}

}  // namespace
}  // namespace prelight
