#include <OpenImageIO/imageio.h>
#include <gtest/gtest.h>

#include <array>
#include <filesystem>
#include <functional>
#include <optional>
#include <random>
#include <span>
#include <string>
#include <vector>

#include "base/files.h"
#include "images/exr.h"
#include "images/image_library.h"
#include "images/plain_png.h"

namespace prelight {
namespace {

constexpr int width = 23, height = 9;

/// A temporary folder for each test.
class PlainPictures : public ::testing::Test {
 protected:
  void SetUp() override {
    const auto* info = testing::UnitTest::GetInstance()->current_test_info();
    folder_ = std::filesystem::path(testing::TempDir()) / (std::string("plain_") + info->name());
    std::filesystem::remove_all(folder_);
    std::filesystem::create_directories(folder_);
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  /// Writes random values through OpenImageIO.
  std::filesystem::path write(const std::string& name, int channels, OIIO::TypeDesc type,
                              const std::function<void(OIIO::ImageSpec&)>& change = {}) {
    std::mt19937 random(7);
    std::uniform_real_distribution<float> even(0.0f, 1.0f);
    std::vector<float> values(std::size_t(width * height * channels));
    for (float& value : values) value = even(random);
    OIIO::ImageSpec spec(width, height, channels, type);
    spec.attribute("oiio:UnassociatedAlpha", 1);
    if (change) change(spec);
    std::filesystem::path path = folder_ / name;
    const auto out = OIIO::ImageOutput::create(path.string());
    EXPECT_TRUE(out->open(path.string(), spec));
    EXPECT_TRUE(out->write_image(OIIO::TypeDesc::FLOAT, values.data()));
    out->close();
    return path;
  }

  static std::vector<std::uint8_t> bytesOf(const std::filesystem::path& path) {
    return readFileBytes(path, path.string());
  }

  std::filesystem::path folder_;
};

TEST_F(PlainPictures, Png_IsAsOpenImageIoHasIt) {
  for (int channels = 1; channels <= 4; ++channels) {
    const std::vector<std::uint8_t> bytes = bytesOf(write("a.png", channels, OIIO::TypeDesc::UINT8));
    const std::optional<Image> plain = decodePlainPng(bytes);
    ASSERT_TRUE(plain) << channels;
    const Image expected = imageLibrary().decodeImage(bytes, PictureFormat::Png, "a.png");
    EXPECT_EQ(plain->width, width);
    EXPECT_EQ(plain->height, height);
    EXPECT_EQ(plain->rgba, expected.rgba) << channels;
  }
}

/// A PNG of 3 x 2 indices 0 1 2, 2 2 1 into the colours (255, 0, 0), (0, 128, 7) and (9, 8, 200).
constexpr auto indexedPng = std::to_array<std::uint8_t>(
    {0x89, 0x50, 0x4e, 0x47, 0x0d, 0x0a, 0x1a, 0x0a, 0x00, 0x00, 0x00, 0x0d, 0x49, 0x48, 0x44, 0x52,
     0x00, 0x00, 0x00, 0x03, 0x00, 0x00, 0x00, 0x02, 0x08, 0x03, 0x00, 0x00, 0x00, 0xaa, 0xaa, 0x96,
     0x28, 0x00, 0x00, 0x00, 0x09, 0x50, 0x4c, 0x54, 0x45, 0xff, 0x00, 0x00, 0x00, 0x80, 0x07, 0x09,
     0x08, 0xc8, 0xb4, 0xaa, 0x96, 0xa5, 0x00, 0x00, 0x00, 0x10, 0x49, 0x44, 0x41, 0x54, 0x78, 0x9c,
     0x63, 0x60, 0x60, 0x64, 0x62, 0x60, 0x62, 0x62, 0x04, 0x00, 0x00, 0x23, 0x00, 0x09, 0x00, 0x94,
     0x94, 0xd2, 0x00, 0x00, 0x00, 0x00, 0x49, 0x45, 0x4e, 0x44, 0xae, 0x42, 0x60, 0x82});

TEST_F(PlainPictures, PngWithAPalette_HasItsColours) {
  const std::optional<Image> plain = decodePlainPng(indexedPng);
  ASSERT_TRUE(plain);
  const std::vector<std::uint8_t> expected = {255, 0, 0,   255, 0, 128, 7,   255, 9, 8,   200, 255,
                                              9,   8, 200, 255, 9, 8,   200, 255, 0, 128, 7,   255};
  EXPECT_EQ(plain->rgba, expected);
  EXPECT_EQ(imageLibrary().decodeImage(indexedPng, PictureFormat::Png, "a.png").rgba, expected);
}

TEST_F(PlainPictures, PngOfAnotherKindOrBroken_IsLeft) {
  EXPECT_FALSE(decodePlainPng(bytesOf(write("b.png", 3, OIIO::TypeDesc::UINT16))));
  std::vector<std::uint8_t> bytes = bytesOf(write("c.png", 3, OIIO::TypeDesc::UINT8));
  for (const std::size_t size : {std::size_t{0}, std::size_t{8}, std::size_t{40}, bytes.size() / 2})
    EXPECT_FALSE(decodePlainPng(std::span(bytes).first(size))) << size;
  bytes[bytes.size() / 2] ^= 0x10;
  EXPECT_FALSE(decodePlainPng(bytes));
}

TEST_F(PlainPictures, Exr_IsAsOpenImageIoHasIt) {
  for (const OIIO::TypeDesc type : {OIIO::TypeDesc::FLOAT, OIIO::TypeDesc::HALF})
    for (const char* compression : {"none", "zip", "piz", "dwab:100"}) {
      const std::vector<std::uint8_t> bytes =
          bytesOf(write("a.exr", 3, type, [&](auto& spec) { spec["compression"] = compression; }));
      const std::optional<Pixels> plain = decodePlainExr(bytes);
      ASSERT_TRUE(plain) << compression;
      const Pixels expected = imageLibrary().decodePixels(bytes, PictureFormat::Exr, "a.exr");
      EXPECT_EQ(plain->width, width);
      EXPECT_EQ(plain->height, height);
      EXPECT_EQ(plain->rgb, expected.rgb) << compression;
    }
}

TEST_F(PlainPictures, ExrOfAnotherKindOrBroken_IsLeft) {
  EXPECT_FALSE(decodePlainExr(bytesOf(write("b.exr", 4, OIIO::TypeDesc::FLOAT))));
  EXPECT_FALSE(decodePlainExr(bytesOf(write("c.exr", 1, OIIO::TypeDesc::FLOAT))));
  EXPECT_FALSE(decodePlainExr(bytesOf(write("d.exr", 3, OIIO::TypeDesc::FLOAT, [](OIIO::ImageSpec& spec) {
    spec.tile_width = spec.tile_height = 16;
  }))));
  EXPECT_FALSE(decodePlainExr(bytesOf(
      write("e.exr", 3, OIIO::TypeDesc::FLOAT, [](OIIO::ImageSpec& spec) { spec.full_width = 2 * width; }))));
  const std::vector<std::uint8_t> bytes = bytesOf(write("f.exr", 3, OIIO::TypeDesc::FLOAT));
  for (std::size_t size = 0; size < bytes.size(); size += 7)
    EXPECT_FALSE(decodePlainExr(std::span(bytes).first(size))) << size;
}

}  // namespace
}  // namespace prelight
