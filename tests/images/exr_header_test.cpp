// Headers that claim more than their files can hold: the libraries would allocate it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstring>
#include <limits>
#include <string>

#include "images/pixels.h"
#include "prelight/error.h"
#include "prelight/picture.h"
#include "support/gltf_files.h"

namespace prelight {
namespace {

using ::testing::HasSubstr;

std::string bytesOf(std::int32_t number) {
  std::string bytes(sizeof number, '\0');
  std::memcpy(bytes.data(), &number, sizeof number);
  return bytes;
}

std::string attribute(const std::string& name, const std::string& type, const std::string& value,
                      std::int32_t claimed) {
  return name + '\0' + type + '\0' + bytesOf(claimed) + value;
}

std::string attribute(const std::string& name, const std::string& type, const std::string& value) {
  return attribute(name, type, value, static_cast<std::int32_t>(value.size()));
}

/// Attributes of an uncompressed picture with this last column and row, and one channel.
std::string usual(std::int32_t right, std::int32_t bottom) {
  const std::string channel =
      std::string("R\0", 2) + bytesOf(2) + bytesOf(0) + bytesOf(1) + bytesOf(1) + '\0';
  return attribute("channels", "chlist", channel) +
         attribute("compression", "compression", std::string(1, '\0')) +
         attribute("dataWindow", "box2i", bytesOf(0) + bytesOf(0) + bytesOf(right) + bytesOf(bottom));
}

class ExrHeader : public ::testing::Test {
 protected:
  /// Message about a file of a version field, attributes, the end of the header and 64 further bytes.
  std::string refusalOf(const std::string& attributes, std::int32_t flags = 0) const {
    test::writeBytes(folder_ / "a.exr",
                     "\x76\x2F\x31\x01" + bytesOf(2 | flags) + attributes + '\0' + std::string(64, '\0'));
    return test::inputErrorOf([&] { (void)readPictureLayers(folder_ / "a.exr"); });
  }

  const test::TemporaryFolder folder_;
};

TEST_F(ExrHeader, WrittenFile_IsRead) {
  const Picture picture{3, 2, std::vector<glm::vec3>(6, {1.0f, 2.0f, 3.0f})};
  writePicture(folder_ / "a.exr", picture, std::vector<PictureChannel>{{"x.Y", std::vector<float>(6, 4.0f)}});
  EXPECT_EQ(readPictureLayers(folder_ / "a.exr").channels.size(), 4u);
}

TEST_F(ExrHeader, AttributeBeyondTheFile_IsRefused) {
  EXPECT_THAT(refusalOf(usual(1, 1) + attribute("capDate", "unknown", "", 1735524352)),
              HasSubstr("attribute \"capDate\" of its header claims 1735524352 bytes"));
  EXPECT_THAT(refusalOf(usual(1, 1) + attribute("capDate", "string", "", -1)), HasSubstr("claims -1 bytes"));
}

/// The library reads values of known types without regard to the size that the header gives them.
TEST_F(ExrHeader, AttributeOfAnotherSizeThanItsType_IsRefused) {
  EXPECT_THAT(refusalOf(usual(1, 1) + attribute("aperture", "float", "12345")),
              HasSubstr("attribute \"aperture\" of its header has 5 bytes, expected 4 of a float"));
  const std::string channel =
      std::string("R\0", 2) + bytesOf(2) + bytesOf(0) + bytesOf(1) + bytesOf(1) + std::string(40, '\0');
  EXPECT_THAT(refusalOf(attribute("channels", "chlist", channel)), HasSubstr("has 58 bytes, expected 19"));
  EXPECT_THAT(refusalOf(usual(1, 1) + attribute("preview", "preview", bytesOf(1) + bytesOf(1) + "123")),
              HasSubstr("has 11 bytes, expected 12"));
  const std::string large = bytesOf(std::numeric_limits<std::int32_t>::min());  // 4 (2^31)^2 is 0 in 64 bits
  EXPECT_THAT(refusalOf(usual(1, 1) + attribute("preview", "preview", large + large)),
              HasSubstr("its preview is cut short"));
}

TEST_F(ExrHeader, MoreTexelsOrNumbersThanTheFileHolds_AreRefused) {
  EXPECT_THAT(refusalOf(usual(2000000000, 2000000000)), HasSubstr("claims 2000000001 x 2000000001 texels"));
  EXPECT_THAT(refusalOf(usual(-1, 3)), HasSubstr("claims 0 x 4 texels"));
  EXPECT_THAT(refusalOf(usual(8191, 8191)), HasSubstr("claims 67108864 numbers"));
}

TEST_F(ExrHeader, MoreChunksThanTheFileHolds_AreRefused) {
  EXPECT_THAT(refusalOf(usual(0, 1023)), HasSubstr("claims 1024 chunks of pixels"));
  EXPECT_THAT(refusalOf(usual(1, 1) + attribute("chunkCount", "int", bytesOf(2000000000)), 0x1000),
              HasSubstr("claims 2000000000 chunks of pixels"));
  EXPECT_THAT(
      refusalOf(usual(1023, 1023) + attribute("tiles", "tiledesc", bytesOf(1) + bytesOf(1) + '\0'), 0x200),
      HasSubstr("claims 1048576 chunks of pixels"));
}

TEST_F(ExrHeader, CutShortOrWithoutEnd_IsRefused) {
  test::writeBytes(folder_ / "a.exr", "\x76\x2F\x31\x01" + bytesOf(2) + "channels");
  EXPECT_THAT(test::inputErrorOf([&] { (void)readPictureLayers(folder_ / "a.exr"); }),
              HasSubstr("cut short"));
  EXPECT_THAT(refusalOf(std::string(1000, 'a')), HasSubstr("a name without end"));
}

std::string hdrRefusal(const std::string& size, std::size_t bytes) {
  const test::TemporaryFolder folder;
  test::writeBytes(folder / "a.hdr",
                   "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n" + size + "\n" + std::string(bytes, '\0'));
  return test::inputErrorOf([&] { (void)readPixels(folder / "a.hdr"); });
}

/// A line of 8192 texels takes 4 bytes and 4 components of 65 runs of 2 bytes.
TEST(HdrHeader, MoreTexelsThanTheFileHolds_AreRefused) {
  EXPECT_THAT(hdrRefusal("-Y 2730 +X 8192", 100),
              HasSubstr("expected at most 268435456 texels and 1430520 bytes"));
  EXPECT_THAT(hdrRefusal("-Y 99999999 +X 99999999", 100), HasSubstr("99999999 x 99999999 texels"));
  EXPECT_THAT(hdrRefusal("-Y 4", 100), HasSubstr("its header is broken or cut short"));
  EXPECT_EQ(hdrRefusal("-Y 2 +X 3", 24), "");
}

/// The library has memory for 256 lines, and one of 200000 texels fits into 13 kB.
TEST(HdrHeader, LineThatIsLongForSoSmallAFile_IsRefused) {
  EXPECT_THAT(hdrRefusal("-Y 1 +X 200000", 13000), HasSubstr("claims 153600000 numbers"));
}

}  // namespace
}  // namespace prelight
