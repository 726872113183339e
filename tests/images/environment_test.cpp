#include "prelight/picture.h"

#include <OpenImageIO/imageio.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <limits>
#include <numbers>

#include "prelight/error.h"

namespace prelight {
namespace {

namespace fs = std::filesystem;

/// A temporary folder for each test.
class EnvironmentTest : public testing::Test {
 protected:
  void SetUp() override {
    const auto* info = testing::UnitTest::GetInstance()->current_test_info();
    folder_ = fs::path(testing::TempDir()) / (std::string("environment_") + info->name());
    fs::remove_all(folder_);
    fs::create_directories(folder_);
  }
  void TearDown() override { fs::remove_all(folder_); }

  fs::path write(const std::string& name, int width, int height, const std::vector<glm::vec3>& texels) const {
    const fs::path path = folder_ / name;
    const auto output = OIIO::ImageOutput::create(path.string());
    output->open(path.string(), OIIO::ImageSpec(width, height, 3, OIIO::TypeDesc::FLOAT));
    output->write_image(OIIO::TypeDesc::FLOAT, texels.data());
    output->close();
    return path;
  }

  fs::path folder_;
};

void expectNear(const glm::dvec3& a, const glm::dvec3& b) { EXPECT_LT(glm::length(a - b), 1e-12); }

TEST_F(EnvironmentTest, Direction_OfLandmarks_FollowsTheConvention) {
  expectNear(Environment::direction(0.5, 0.5), {0, 0, -1});
  expectNear(Environment::direction(0.75, 0.5), {1, 0, 0});
  expectNear(Environment::direction(0.25, 0.5), {-1, 0, 0});
  expectNear(Environment::direction(0.0, 0.5), {0, 0, 1});
  expectNear(Environment::direction(0.3, 0.0), {0, 1, 0});
  expectNear(Environment::direction(0.3, 1.0), {0, -1, 0});
}

TEST_F(EnvironmentTest, Coordinates_OfADirection_AreItsInverse) {
  for (double u = 0.01; u < 1.0; u += 0.07) {
    for (double v = 0.01; v < 1.0; v += 0.07) {
      const glm::dvec2 back = Environment::coordinates(Environment::direction(u, v));
      EXPECT_NEAR(back.x, u, 1e-12);
      EXPECT_NEAR(back.y, v, 1e-12);
    }
  }
}

TEST_F(EnvironmentTest, Read_ExrAndHdr_KeepRowsAndColumns) {
  const std::vector<glm::vec3> texels = {{1, 2, 3}, {4, 5, 6}, {7, 8, 9}, {0.5, 0.25, 0}};
  for (const char* name : {"sky.exr", "sky.hdr", "SKY.EXR"}) {
    const Environment sky = readEnvironment(write(name, 2, 2, texels));
    ASSERT_EQ(sky.width, 2);
    ASSERT_EQ(sky.height, 2);
    for (int i = 0; i < 4; ++i)
      EXPECT_LT(glm::length(sky.radiance[i] - texels[i]), 0.05f) << name << " " << i;
  }
}

TEST_F(EnvironmentTest, Read_NegativeOrNonFiniteTexel_IsRefusedByPlace) {
  constexpr float infinity = std::numeric_limits<float>::infinity();
  for (const float bad : {-1.0f, -0.05f, std::nanf(""), infinity, -infinity}) {
    const auto path = write("odd.exr", 2, 2, {{1, 1, 1}, {1, 1, 1}, {1, 1, 1}, {1, bad, 1}});
    try {
      readEnvironment(path);
      ADD_FAILURE() << bad << " was taken";
    } catch (const InputError& error) {
      EXPECT_NE(std::string(error.what()).find("column 1, row 1"), std::string::npos) << error.what();
    }
  }
}

/// Products of such a sky with other numbers would not be finite.
TEST_F(EnvironmentTest, Read_RadianceBeyondMeasure_IsRefused) {
  const auto path = write("bright.exr", 2, 1, {{1, 1, 1}, {1, 1e38f, 1}});
  try {
    readEnvironment(path);
    ADD_FAILURE() << "taken";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("column 1, row 0"), std::string::npos) << error.what();
  }
  EXPECT_EQ(readEnvironment(write("sun.exr", 2, 1, {{1, 1, 1}, {1, 1e14f, 1}})).radiance[1].y, 1e14f);
}

TEST_F(EnvironmentTest, Read_RoundingBelowZero_BecomesZero) {
  const Environment sky =
      readEnvironment(write("odd.exr", 2, 1, {{1.0f, -0.001f, 2.0f}, {0.5f, 0.0f, 0.5f}}));
  EXPECT_EQ(sky.radiance[0], glm::vec3(1.0f, 0.0f, 2.0f));
}

TEST_F(EnvironmentTest, Read_MissingFile_NamesIt) {
  try {
    readEnvironment(folder_ / "none.exr");
    FAIL() << "no error";
  } catch (const InputError& error) {
    EXPECT_EQ(error.code(), ExitCode::BadInput);
    EXPECT_THAT(error.what(), testing::HasSubstr("none.exr"));
  }
}

TEST_F(EnvironmentTest, Read_BrokenFiles_AreInputErrors) {
  std::ofstream(folder_ / "text.exr") << "not a picture";
  std::ofstream(folder_ / "empty.hdr");
  const fs::path whole = write("cut.exr", 64, 32, std::vector<glm::vec3>(64 * 32, glm::vec3(0.3f)));
  fs::resize_file(whole, fs::file_size(whole) / 2);
  write("sky.png", 1, 1, {{1, 1, 1}});
  for (const char* name : {"text.exr", "empty.hdr", "cut.exr", "sky.png"}) {
    EXPECT_THROW(readEnvironment(folder_ / name), InputError) << name;
  }
  EXPECT_THROW(readEnvironment(folder_), InputError);
}

TEST_F(EnvironmentTest, Constant_AnyRadiance_IsOneTexel) {
  const Environment sky = constantEnvironment({1, 2, 3});
  ASSERT_EQ(sky.radiance.size(), 1u);
  EXPECT_EQ(sky.radiance[0], glm::vec3(1, 2, 3));
}

}  // namespace
}  // namespace prelight
