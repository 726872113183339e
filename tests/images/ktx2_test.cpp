// Basis Universal textures that the test packs itself, following the Khronos Data Format and KTX 2.0.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <zstd.h>

#include <algorithm>
#include <random>

#include "images/basis/ktx2.h"
#include "images/ktx2_files.h"
#include "images/picture_codecs.h"
#include "prelight/error.h"

namespace prelight {
namespace {

using Bytes = std::vector<std::uint8_t>;
using test::BitWriter;
using test::ktx2File;
using test::Ktx2Parts;

Bytes padded(Bytes block) {
  block.resize(16);
  return block;
}

std::vector<int> texel(const Image& image, int x, int y) {
  const std::uint8_t* at = &image.rgba[4 * static_cast<std::size_t>(y * image.width + x)];
  return {at[0], at[1], at[2], at[3]};
}

Image imageOf(const Bytes& level, Ktx2Parts parts = {}) {
  parts.level = level;
  return decodeImage(ktx2File(parts), "a.glb: /images/0");
}

Image plainImage(std::uint32_t format, const Bytes& level, std::uint32_t width, std::uint32_t height) {
  Ktx2Parts parts;
  parts.format = format;
  parts.width = width;
  parts.height = height;
  parts.model = 1;
  parts.channels = {0, 1, 2};
  return imageOf(level, parts);
}

/// Uses Vulkan's format numbers of R8, R8G8, R8G8B8, B8G8R8 and R8G8B8A8, and their sRGB variants.
TEST(PlainKtx2, Bytes_AreTheTexels) {
  const Bytes level = {1, 2, 3, 4, 5, 6, 7, 8};
  using Texel = std::vector<int>;
  EXPECT_EQ(texel(plainImage(9, level, 2, 2), 1, 1), (Texel{4, 0, 0, 255}));
  EXPECT_EQ(texel(plainImage(16, level, 2, 2), 0, 1), (Texel{5, 6, 0, 255}));
  EXPECT_EQ(texel(plainImage(23, level, 2, 1), 1, 0), (Texel{4, 5, 6, 255}));
  EXPECT_EQ(texel(plainImage(29, level, 1, 2), 0, 1), (Texel{4, 5, 6, 255}));
  EXPECT_EQ(texel(plainImage(30, level, 2, 1), 1, 0), (Texel{6, 5, 4, 255}));
  EXPECT_EQ(texel(plainImage(37, level, 2, 1), 1, 0), (Texel{5, 6, 7, 8}));
  EXPECT_EQ(texel(plainImage(43, level, 2, 1), 0, 0), (Texel{1, 2, 3, 4}));
}

TEST(PlainKtx2, Zstandard_IsInflated) {
  const Bytes texels = {10, 20, 30, 40, 50, 60};
  Bytes packed(ZSTD_compressBound(texels.size()));
  packed.resize(ZSTD_compress(packed.data(), packed.size(), texels.data(), texels.size(), 3));
  Ktx2Parts parts;
  parts.format = 23;
  parts.width = 2;
  parts.height = 1;
  parts.compression = 2;
  parts.levelBytes = texels.size();
  EXPECT_EQ(texel(imageOf(packed, parts), 1, 0), (std::vector<int>{40, 50, 60, 255}));
}

TEST(PlainKtx2, TooFewBytesAndOtherFormats_AreRefused) {
  EXPECT_THROW(plainImage(23, {1, 2, 3, 4, 5}, 2, 1), InputError);
  EXPECT_THROW(plainImage(97, Bytes(64), 2, 1), InputError);  // Half floats.
  Ktx2Parts parts;
  parts.format = 37;
  parts.compression = 1;
  EXPECT_THROW(imageOf(Bytes(64), parts), InputError);
}

/// Mode 8: one colour.
TEST(Uastc, SolidBlock_IsItsColour) {
  const Image image =
      imageOf(padded(BitWriter().add(0x17, 5).add(200, 8).add(100, 8).add(50, 8).add(25, 8).bytes()));
  EXPECT_EQ(image.width, 4);
  for (int i = 0; i < 16; ++i) EXPECT_EQ(texel(image, i % 4, i / 4), (std::vector<int>{200, 100, 50, 25}));
}

/// Mode 1: two colours of eight bits, and weights of two bits, of which the first texel stores one.
TEST(Uastc, OpaqueBlock_InterpolatesItsEndpoints) {
  BitWriter block;
  block.add(0x35, 6).add(0, 15);
  // Low and high of R, G, B.
  for (const unsigned value : {10u, 250u, 0u, 64u, 255u, 1u}) block.add(value, 8);
  block.add(0, 1);
  for (unsigned i = 1; i < 16; ++i) block.add(i % 4, 2);
  const Image image = imageOf(padded(block.bytes()));
  EXPECT_EQ(texel(image, 0, 0), (std::vector<int>{10, 0, 255, 255}));
  EXPECT_EQ(texel(image, 3, 0), (std::vector<int>{250, 64, 1, 255}));
  // Endpoints have 16 bits when they are mixed: 257 times their 8-bit value.
  EXPECT_EQ(texel(image, 1, 2)[0], (257 * (10 * 43 + 250 * 21) + 32) / 64 / 256);
  EXPECT_EQ(texel(image, 2, 3)[1], 64 * 43 / 64);
}

/// Mode 9: two subsets with alpha. Pattern 0 is left and right halves. Four bits abcd expand to the byte
/// abcdabcd.
TEST(Uastc, TwoSubsets_HaveEndpointsOfTheirOwn) {
  BitWriter block;
  block.add(0x0F, 5).add(0, 23).add(0, 5);
  for (const unsigned value : {1u, 2u, 3u, 4u, 5u, 6u, 7u, 8u}) block.add(value, 4);
  for (const unsigned value : {15u, 14u, 13u, 12u, 11u, 10u, 9u, 8u}) block.add(value, 4);
  for (unsigned i = 0; i < 16; ++i) block.add(0, i == 0 || i == 2 ? 1 : 2);
  const Image image = imageOf(padded(block.bytes()));
  EXPECT_EQ(texel(image, 1, 1), (std::vector<int>{17, 51, 85, 119}));
  EXPECT_EQ(texel(image, 2, 3), (std::vector<int>{255, 221, 187, 153}));
}

/// Mode 10: trits with four bits, indexed as (trit << 4 | bits) in the specification's table.
TEST(Uastc, Trits_AreUnquantisedAsTheTableSays) {
  BitWriter block;
  block.add(0x02, 3).add(0, 17);
  // Low of R, high of R, low of G, ...: trits 0 1 2 0 1 and 2 0 1; bits 1, 2, 3, 15, 5, 6, 7, 8.
  block.add(0 + 3 * 1 + 9 * 2 + 27 * 0 + 81 * 1, 8).add(2 + 3 * 0 + 9 * 1, 5);
  for (const unsigned bits : {1u, 2u, 3u, 15u, 5u, 6u, 7u, 8u}) block.add(bits, 4);
  for (unsigned i = 0; i < 16; ++i) block.add(i == 0 ? 0 : 15, i == 0 ? 3 : 4);
  const Image image = imageOf(padded(block.bytes()));
  EXPECT_EQ(texel(image, 0, 0), (std::vector<int>{255, 228, 217, 207}));    // Entries 1, 35, 21, 7.
  EXPECT_EQ(texel(image, 1, 0), (std::vector<int>{21, 142, 43 + 16, 70}));  // Entries 18, 15, 38, 24.
}

TEST(Uastc, NoMode_IsMagenta) {
  EXPECT_EQ(texel(imageOf(padded({0x45})), 2, 2), (std::vector<int>{255, 0, 255, 255}));
}

TEST(Ktx2, ZstandardAndSizesThatAreNoMultiples_AreRead) {
  Bytes blocks;
  for (unsigned b = 0; b < 6; ++b) {
    const Bytes block =
        padded(BitWriter().add(0x17, 5).add(10 * b, 8).add(0, 8).add(0, 8).add(255, 8).bytes());
    blocks.insert(blocks.end(), block.begin(), block.end());
  }
  Bytes packed(ZSTD_compressBound(blocks.size()));
  packed.resize(ZSTD_compress(packed.data(), packed.size(), blocks.data(), blocks.size(), 3));
  Ktx2Parts parts;
  parts.width = 9;
  parts.height = 6;
  parts.compression = 2;
  parts.levelBytes = blocks.size();
  const Image image = imageOf(packed, parts);
  EXPECT_EQ(image.width, 9);
  EXPECT_EQ(image.height, 6);
  EXPECT_EQ(texel(image, 8, 5)[0], 50);
  EXPECT_EQ(texel(image, 3, 5)[0], 30);
}

/// Writes a Huffman table of `lengths` in the simplest way: every length on its own, in five bits.
void addTable(BitWriter& writer, const std::vector<unsigned>& lengths) {
  writer.add(lengths.size(), 14).add(21, 5);
  for (int i = 0; i < 21; ++i) writer.add(5, 3);
  for (const unsigned length : lengths) {
    for (int bit = 4; bit >= 0; --bit) writer.add(length >> bit & 1, 1);  // Codes start with the highest bit.
  }
}

/// Two endpoints, two selectors, and a picture of 8 x 4 texels.
Ktx2Parts etc1sParts() {
  BitWriter endpoints;
  addTable(endpoints, {0, 1, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 1});  // Below 10: symbols 1 or 16.
  // 10 to 21: symbols 0, 1, 2 or 16.
  addTable(endpoints, {2, 2, 2, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 2});
  addTable(endpoints, {1});
  addTable(endpoints, {1, 1});
  endpoints.add(0, 1);
  // The first block has table 0 and colour (16, 17, 18), the second table 1 and colour (0, 17, 18).
  endpoints.add(0, 1).add(0b00, 2).add(0b10, 2).add(0b01, 2);
  endpoints.add(1, 1).add(0b11, 2).add(0b00, 2).add(0b00, 2);
  BitWriter selectors;
  selectors.add(0, 2).add(1, 1);
  for (const unsigned row : {0xE4u, 0xE4u, 0xE4u, 0xE4u, 0x00u, 0x55u, 0xAAu, 0xFFu}) selectors.add(row, 8);
  BitWriter tables;
  std::vector<unsigned> predictions(16, 0);
  predictions[3] = predictions[15] = 1;
  addTable(tables, predictions);
  addTable(tables, {1, 1});
  addTable(tables, {1, 1});
  tables.add(0, 14);  // No runs of selectors.
  tables.add(0, 13);
  // One group of two blocks. Prediction 15 sends both endpoints, with differences 0 and 1; selectors 0 and 1
  // follow.
  BitWriter slice;
  slice.add(1, 1).add(0, 1).add(0, 1).add(1, 1).add(1, 1);
  Ktx2Parts parts;
  parts.width = 8;
  parts.compression = 1;
  parts.model = 163;
  parts.level = slice.bytes();
  BitWriter globals;
  globals.add(2, 16).add(2, 16);
  for (const BitWriter* part : {&endpoints, &selectors, &tables}) globals.add(part->bytes().size(), 32);
  globals.add(0, 32).add(0, 32).add(0, 32).add(parts.level.size(), 32).add(0, 32).add(0, 32);
  for (const BitWriter* part : {&endpoints, &selectors, &tables}) {
    for (const std::uint8_t byte : part->bytes()) globals.add(byte, 8);
  }
  parts.globals = globals.bytes();
  return parts;
}

/// Five bits c expand to the byte c << 3 | c >> 2. The modifiers are -8, -2, 2, 8 and -17, -5, 5, 17.
TEST(Etc1s, Blocks_AreTheirColoursAndModifiers) {
  const Image image = decodeImage(ktx2File(etc1sParts()), "x");
  EXPECT_EQ(texel(image, 0, 0), (std::vector<int>{132 - 8, 140 - 8, 148 - 8, 255}));
  EXPECT_EQ(texel(image, 1, 2), (std::vector<int>{132 - 2, 140 - 2, 148 - 2, 255}));
  EXPECT_EQ(texel(image, 3, 3), (std::vector<int>{132 + 8, 140 + 8, 148 + 8, 255}));
  EXPECT_EQ(texel(image, 5, 0), (std::vector<int>{0, 140 - 17, 148 - 17, 255}));
  EXPECT_EQ(texel(image, 5, 2), (std::vector<int>{5, 140 + 5, 148 + 5, 255}));
}

std::string errorOf(const Ktx2Parts& parts) {
  try {
    (void)decodeImage(ktx2File(parts), "a.glb: /images/0");
  } catch (const InputError& error) {
    return error.what();
  }
  return {};
}

TEST(Ktx2, OtherContents_AreNamed) {
  Ktx2Parts parts = etc1sParts();
  parts.model = 1;
  EXPECT_THAT(errorOf(parts),
              testing::HasSubstr("a.glb: /images/0: cannot decode the KTX2 picture: colour model 1"));
  parts = etc1sParts();
  parts.level.clear();
  EXPECT_THAT(errorOf(parts), testing::HasSubstr("slice is cut short"));
  parts.width = 1u << 30;
  EXPECT_THAT(errorOf(parts), testing::HasSubstr("scale the picture down"));
}

TEST(Ktx2, Damaged_DecodesOrThrows) {
  std::mt19937 random(8);
  const Bytes etc1s = ktx2File(etc1sParts());
  Ktx2Parts parts;
  parts.level.resize(64);
  for (auto& byte : parts.level) byte = static_cast<std::uint8_t>(random());
  parts.width = parts.height = 8;
  const Bytes uastc = ktx2File(parts);
  int refused = 0;
  for (int i = 0; i < 4000; ++i) {
    Bytes bytes = i % 2 == 0 ? etc1s : uastc;
    for (auto flips = 1 + random() % 3; flips > 0; --flips)
      bytes[random() % bytes.size()] = static_cast<std::uint8_t>(random());
    bytes[22] = bytes[23] = bytes[26] = bytes[27] = 0;  // Sizes of up to 65535 take long, and are allowed.
    bytes[21] = bytes[25] = 0;
    if (random() % 8 == 0) bytes.resize(1 + random() % bytes.size());
    try {
      (void)decodeImage(bytes, "x");
    } catch (const InputError&) {
      ++refused;
    }
  }
  EXPECT_GT(refused, 500);
  EXPECT_LT(refused, 3900);
}

}  // namespace
}  // namespace prelight
