#include "prelight/picture.h"

#include <OpenImageIO/imageio.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <cmath>
#include <fstream>
#include <limits>

#include "io/finite_results.h"
#include "prelight/error.h"

namespace prelight {
namespace {

namespace fs = std::filesystem;

/// A temporary folder for each test.
class PictureTest : public testing::Test {
 protected:
  void SetUp() override {
    const auto* info = testing::UnitTest::GetInstance()->current_test_info();
    folder_ = fs::path(testing::TempDir()) / (std::string("picture_") + info->name());
    fs::remove_all(folder_);
    fs::create_directories(folder_);
  }
  void TearDown() override { fs::remove_all(folder_); }

  std::vector<std::string> files() const {
    std::vector<std::string> names;
    for (const auto& entry : fs::directory_iterator(folder_)) names.push_back(entry.path().filename());
    return names;
  }

  fs::path folder_;
};

Picture gradient(int width, int height) {
  Picture picture{width, height, {}};
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) picture.pixels.emplace_back(0.7 * x / width, 0.7 * y / height, 0.2);
  }
  return picture;
}

TEST_F(PictureTest, Exr_RoundTrip_IsExact) {
  Picture picture = gradient(17, 9);
  picture.pixels[3] = {12345.678f, 1e-7f, -2.0f};
  writePicture(folder_ / "a.exr", picture);
  const Picture back = readPicture(folder_ / "a.exr");
  ASSERT_EQ(back.width, 17);
  ASSERT_EQ(back.height, 9);
  EXPECT_EQ(back.pixels, picture.pixels);
  EXPECT_THAT(files(), testing::ElementsAre("a.exr"));
}

TEST_F(PictureTest, Exr_WithAFurtherChannel_IsAPlainPictureFirst) {
  const Picture picture = gradient(5, 3);
  std::vector<float> variance(15);
  for (std::size_t i = 0; i < variance.size(); ++i) variance[i] = 0.5f * static_cast<float>(i);
  const fs::path file = folder_ / "a.exr";
  writePicture(file, picture, {{"variance.Y", variance}});
  EXPECT_EQ(readPicture(file).pixels, picture.pixels);
  const auto input = OIIO::ImageInput::open(file.string());
  ASSERT_TRUE(input);
  EXPECT_THAT(input->spec().channelnames, testing::ElementsAre("R", "G", "B"));
  ASSERT_TRUE(input->seek_subimage(1, 0));
  EXPECT_THAT(input->spec().channelnames, testing::ElementsAre("variance.Y"));
  std::vector<float> back(15);
  ASSERT_TRUE(input->read_image(1, 0, 0, 1, OIIO::TypeDesc::FLOAT, back.data()));
  EXPECT_EQ(back, variance);
}

TEST_F(PictureTest, Png_Written_HoldsTheToneMappedColours) {
  const Picture picture = gradient(8, 4);
  writePicture(folder_ / "a.png", picture);
  const Picture back = readPicture(folder_ / "a.png");
  ASSERT_EQ(back.pixels.size(), picture.pixels.size());
  const auto encode = [](double v) {
    return v <= 0.0031308 ? 12.92 * v : 1.055 * std::pow(v, 1 / 2.4) - 0.055;
  };
  for (std::size_t i = 0; i < back.pixels.size(); ++i) {
    const glm::vec3 expected = toneMap(picture.pixels[i]);
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(encode(back.pixels[i][c]), expected[c], 0.5 / 255 + 1e-6) << i;
  }
}

TEST_F(PictureTest, Write_UnknownExtension_IsAUsageError) {
  EXPECT_THROW(writePicture(folder_ / "a.bmp", gradient(2, 2)), UsageError);
  EXPECT_THROW(writePicture(folder_ / "a", gradient(2, 2)), UsageError);
  EXPECT_TRUE(files().empty());
}

TEST_F(PictureTest, Write_FolderMissing_SaysWhichFileAndWhy) {
  try {
    writePicture(folder_ / "none" / "a.exr", gradient(2, 2));
    FAIL() << "no error";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::RuntimeFailure);
    EXPECT_THAT(error.what(), testing::HasSubstr("a.exr"));
  }
}

TEST_F(PictureTest, Write_ExistingFile_IsReplaced) {
  writePicture(folder_ / "a.exr", gradient(4, 4));
  writePicture(folder_ / "a.exr", gradient(2, 3));
  EXPECT_EQ(readPicture(folder_ / "a.exr").height, 3);
}

TEST_F(PictureTest, Read_BrokenFiles_AreInputErrors) {
  std::ofstream(folder_ / "a.png") << "not a picture";
  std::ofstream(folder_ / "a.txt") << "text";
  for (const char* name : {"a.png", "a.txt", "none.png"}) {
    EXPECT_THROW(readPicture(folder_ / name), InputError) << name;
  }
}

/// The name says EXR or PNG, but the bytes are of another format, whose reader must not run.
TEST_F(PictureTest, Read_OtherFormatThanExpected_IsRefusedByItsName) {
  for (const char* name : {"a.exr", "a.png"}) {
    std::ofstream(folder_ / name, std::ios::binary) << "DDS |" << std::string(123, '\0');
    try {
      readPicture(folder_ / name);
      ADD_FAILURE() << name;
    } catch (const InputError& error) {
      EXPECT_THAT(error.what(), testing::HasSubstr("it is DDS, expected EXR, HDR, PNG, JPEG"));
    }
  }
}

/// 16000 x 16000 texels of RGB would be 3 GB.
TEST_F(PictureTest, Read_HeaderOfMoreThanItsFileHolds_IsRefused) {
  std::ofstream(folder_ / "a.hdr", std::ios::binary)
      << "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 16000 +X 16000\n"
      << std::string(64, '\2');
  try {
    readPicture(folder_ / "a.hdr");
    ADD_FAILURE();
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), testing::HasSubstr("16000 x 16000 texels in 117 bytes"));
  }
}

TEST_F(PictureTest, Read_PipeOrDevice_IsRefusedWithoutWaiting) {
  ASSERT_EQ(mkfifo((folder_ / "pipe.exr").c_str(), 0600), 0);
  fs::create_symlink("/dev/zero", folder_ / "zero.exr");
  EXPECT_THROW(readPicture(folder_ / "pipe.exr"), InputError);
  EXPECT_THROW(readPicture(folder_ / "zero.exr"), InputError);
}

TEST_F(PictureTest, RequireFinite_NamesThePixel) {
  Picture picture = gradient(4, 3);
  EXPECT_NO_THROW(requireFinite("a.exr", picture));
  for (const float bad : {std::nanf(""), std::numeric_limits<float>::infinity()}) {
    picture.pixels[6].y = bad;
    try {
      requireFinite("a.exr", picture);
      ADD_FAILURE() << bad;
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ExitCode::RuntimeFailure);
      EXPECT_THAT(error.what(), testing::HasSubstr("column 2, row 1"));
    }
  }
}

TEST_F(PictureTest, ToneMap_Black_StaysBlack) { EXPECT_EQ(toneMap(glm::vec3(0.0f)), glm::vec3(0.0f)); }

// Below its compression, Khronos PBR Neutral maps a grey x to x - 0.04 from 0.08 on, and to x^2 / 0.16 below.
TEST_F(PictureTest, ToneMap_MidGreys_FollowKhronosPbrNeutral) {
  const auto decode = [](double v) { return v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4); };
  EXPECT_NEAR(decode(toneMap(glm::vec3(0.5f)).x), 0.46, 1e-5);
  EXPECT_NEAR(decode(toneMap(glm::vec3(0.04f)).x), 0.01, 1e-5);
  // With a peak of 1.96, x = 1 - 0.24^2 / (1.96 + 0.24 - 0.76) = 0.96.
  EXPECT_NEAR(decode(toneMap(glm::vec3(2.0f)).x), 0.96, 1e-5);
}

TEST_F(PictureTest, ToneMap_AnyInput_StaysInRangeAndMonotonic) {
  constexpr float infinity = std::numeric_limits<float>::infinity();
  float before = -1.0f;
  for (const float radiance : {-1.0f, 0.01f, 0.1f, 0.5f, 0.76f, 0.81f, 1.0f, 5.0f, 1e3f, 1e30f, infinity}) {
    const glm::vec3 shown = toneMap(glm::vec3(radiance));
    EXPECT_GE(shown.x, before) << radiance;
    EXPECT_LE(shown.x, 1.0f);
    before = shown.x;
  }
  EXPECT_EQ(toneMap(glm::vec3(std::nanf(""))), glm::vec3(0.0f));
  const glm::vec3 mixed = toneMap({infinity, 0.0f, -infinity});
  for (int c = 0; c < 3; ++c) EXPECT_TRUE(mixed[c] >= 0.0f && mixed[c] <= 1.0f);
}

}  // namespace
}  // namespace prelight
