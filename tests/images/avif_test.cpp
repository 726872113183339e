// Pictures that libavif encodes in the test.
#include <avif/avif.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "images/picture_codecs.h"
#include "images/picture_header.h"
#include "prelight/error.h"

namespace prelight {
namespace {

using Bytes = std::vector<std::uint8_t>;

/// Red grows to the right, green downwards; the left half is half transparent.
Bytes gradient(std::uint32_t width, std::uint32_t height) {
  Bytes rgba;
  for (std::uint32_t y = 0; y < height; ++y) {
    for (std::uint32_t x = 0; x < width; ++x)
      rgba.insert(rgba.end(), {std::uint8_t(x * 255 / width), std::uint8_t(y * 255 / height), 60,
                               std::uint8_t(2 * x < width ? 128 : 255)});
  }
  return rgba;
}

/// A lossless AVIF: quantisers of 0 and the identity for YUV.
Bytes avif(std::uint32_t width, std::uint32_t height) {
  Bytes rgba = gradient(width, height);
  avifImage* image = avifImageCreate(width, height, 8, AVIF_PIXEL_FORMAT_YUV444);
  image->matrixCoefficients = AVIF_MATRIX_COEFFICIENTS_IDENTITY;
  avifRGBImage rgb{};
  avifRGBImageSetDefaults(&rgb, image);
  rgb.pixels = rgba.data();
  rgb.rowBytes = 4 * width;
  EXPECT_EQ(avifImageRGBToYUV(image, &rgb), AVIF_RESULT_OK);
  avifEncoder* encoder = avifEncoderCreate();
  encoder->minQuantizer = encoder->maxQuantizer = AVIF_QUANTIZER_LOSSLESS;
  encoder->minQuantizerAlpha = encoder->maxQuantizerAlpha = AVIF_QUANTIZER_LOSSLESS;
  encoder->speed = AVIF_SPEED_FASTEST;
  avifRWData data = AVIF_DATA_EMPTY;
  EXPECT_EQ(avifEncoderWrite(encoder, image, &data), AVIF_RESULT_OK);
  Bytes bytes(data.data, data.data + data.size);
  avifRWDataFree(&data);
  avifEncoderDestroy(encoder);
  avifImageDestroy(image);
  return bytes;
}

TEST(Avif, Header_TellsFormatAndExtent) {
  const Bytes bytes = avif(37, 20);
  EXPECT_EQ(pictureFormat(bytes), PictureFormat::Avif);
  EXPECT_EQ(imageMimeType(bytes), "image/avif");
  const auto extent = pictureExtent(bytes);
  ASSERT_TRUE(extent);
  EXPECT_EQ(extent->width, 37u);
  EXPECT_EQ(extent->height, 20u);
}

TEST(Avif, WithoutLoss_DecodesToWhatWentIn) {
  const Image image = decodeImage(avif(37, 20), "x");
  EXPECT_EQ(image.width, 37);
  EXPECT_EQ(image.height, 20);
  EXPECT_EQ(image.rgba, gradient(37, 20));
}

/// Position of the picture's sizes: after "ispe" and four bytes of version and flags.
std::size_t placeOfSize(const Bytes& bytes) {
  const std::string text(bytes.begin(), bytes.end());
  return text.find("ispe") + 8;
}

TEST(Avif, MoreTexelsThanAreDecoded_IsRefused) {
  Bytes bytes = avif(16, 16);
  for (std::size_t i = 0; i < 8; ++i) bytes[placeOfSize(bytes) + i] = i % 4 == 2 ? 0xFF : 0;
  EXPECT_THROW((void)decodeImage(bytes, "x"), InputError);
}

/// The stream has more texels than its header says.
TEST(Avif, StreamBeyondItsHeader_IsRefused) {
  Bytes bytes = avif(400, 300);
  for (std::size_t i = 0; i < 8; ++i) bytes[placeOfSize(bytes) + i] = i % 4 == 3 ? 8 : 0;
  EXPECT_THROW((void)decodeImage(bytes, "x"), InputError);
}

TEST(Avif, Damaged_DecodesOrThrows) {
  const Bytes good = avif(24, 24);
  std::mt19937 random(4);
  int refused = 0;
  for (int i = 0; i < 600; ++i) {
    Bytes bytes = good;
    for (auto flips = 1 + random() % 3; flips > 0; --flips)
      bytes[random() % bytes.size()] = static_cast<std::uint8_t>(random());
    if (random() % 8 == 0) bytes.resize(1 + random() % bytes.size());
    try {
      (void)decodeImage(bytes, "x");
    } catch (const InputError&) {
      ++refused;
    }
  }
  EXPECT_GT(refused, 100);
}

}  // namespace
}  // namespace prelight
