#include "images/picture_header.h"

#include <gtest/gtest.h>

#include <string_view>
#include <vector>

#include "images/picture_codecs.h"

namespace prelight {
namespace {

using Bytes = std::vector<std::uint8_t>;

/// A RIFF file of one WebP chunk (RFC 9649, 2.3 to 2.7). The reader ignores the sizes of file and chunk.
Bytes webp(std::string_view chunk, const Bytes& payload) {
  Bytes bytes = {'R', 'I', 'F', 'F', 0, 0, 0, 0, 'W', 'E', 'B', 'P'};
  bytes.insert(bytes.end(), chunk.begin(), chunk.end());
  bytes.insert(bytes.end(), 4, 0);
  bytes.insert(bytes.end(), payload.begin(), payload.end());
  return bytes;
}

/// A VP8 key frame (RFC 6386, 9.1): tag, start code, then for each side 14 bits of length below 2 bits of
/// scale.
Bytes lossyWebp(unsigned width, unsigned height, unsigned scaleX, unsigned scaleY) {
  const unsigned x = width | scaleX << 14, y = height | scaleY << 14;
  return webp("VP8 ", {0x30, 0x01, 0x00, 0x9D, 0x01, 0x2A, std::uint8_t(x), std::uint8_t(x >> 8),
                       std::uint8_t(y), std::uint8_t(y >> 8)});
}

/// A baseline frame header (ITU-T T.81, B.2.2) of 5 x 3 texels after `before`.
Bytes jpeg(const Bytes& before) {
  Bytes bytes = {0xFF, 0xD8};
  bytes.insert(bytes.end(), before.begin(), before.end());
  const Bytes frame = {0xFF, 0xC0, 0x00, 0x0B, 8, 0x00, 3, 0x00, 5, 1, 1, 0x11, 0};
  bytes.insert(bytes.end(), frame.begin(), frame.end());
  return bytes;
}

void expectExtent(const Bytes& bytes, std::uint64_t width, std::uint64_t height) {
  const std::optional<PictureExtent> extent = pictureExtent(bytes);
  ASSERT_TRUE(extent);
  EXPECT_EQ(extent->width, width);
  EXPECT_EQ(extent->height, height);
}

TEST(PictureHeader, LossyWebp_HasTheSidesWithoutTheirScales) {
  expectExtent(lossyWebp(300, 0x3FFF, 0, 0), 300, 16383);
  expectExtent(lossyWebp(300, 200, 1, 2), 300, 200);
}

TEST(PictureHeader, ExtendedWebp_HasTheSidesOfItsCanvas) {
  expectExtent(webp("VP8X", {0x10, 0, 0, 0, 0x2B, 0x01, 0, 0xFF, 0xFF, 0x01}), 300, 1 << 17);
}

TEST(PictureHeader, LosslessWebp_HasTheSidesOfItsFirstBits) {
  // 299 in 14 bits, then 199 in 14 bits, least significant bit first.
  const unsigned bits = 299u | 199u << 14;
  expectExtent(webp("VP8L", {0x2F, std::uint8_t(bits), std::uint8_t(bits >> 8), std::uint8_t(bits >> 16),
                             std::uint8_t(bits >> 24)}),
               300, 200);
}

TEST(PictureHeader, WebpOfOtherChunksOrCutShort_HasNoExtent) {
  EXPECT_FALSE(pictureExtent(webp("ALPH", Bytes(10, 1))));
  EXPECT_FALSE(pictureExtent(lossyWebp(0, 200, 0, 0)));
  Bytes cut = lossyWebp(300, 200, 0, 0);
  cut.pop_back();
  EXPECT_FALSE(pictureExtent(cut));
}

TEST(PictureHeader, JpegWithFillBytesAndMarkersWithoutASegment_IsReadOn) {
  expectExtent(jpeg({}), 5, 3);
  expectExtent(jpeg({0xFF, 0xFF, 0xFF}), 5, 3);        // B.1.1.2: any number of fill bytes before a marker.
  expectExtent(jpeg({0xFF, 0x01, 0xFF, 0xD3}), 5, 3);  // B.1.1.3: TEM and RST stand alone.
  expectExtent(jpeg({0xFF, 0xC4, 0x00, 0x03, 0x07}), 5, 3);  // A table.
  EXPECT_FALSE(pictureExtent(jpeg({0xFF, 0xDA})));
  EXPECT_FALSE(pictureExtent(jpeg({0x00, 0x00})));
}

TEST(ImageMimeType, FirstBytes_NameTheType) {
  const auto typeOf = [](std::string_view text) { return imageMimeType(Bytes(text.begin(), text.end())); };
  EXPECT_EQ(typeOf("\x89PNG\r\n"), "image/png");
  EXPECT_EQ(imageMimeType(jpeg({})), "image/jpeg");
  EXPECT_EQ(imageMimeType(lossyWebp(1, 1, 0, 0)), "image/webp");
  EXPECT_EQ(typeOf("\xABKTX 20\xBB"), "image/ktx2");
  EXPECT_EQ(typeOf("DDS |"), "image/vnd-ms.dds");
  EXPECT_EQ(typeOf("BM...."), "image/bmp");
  EXPECT_EQ(typeOf("GIF89a"), "");
  EXPECT_EQ(typeOf("RIFX....WEBP"), "") << "of another byte order";
}

}  // namespace
}  // namespace prelight
