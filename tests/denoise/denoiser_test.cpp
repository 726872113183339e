#include "denoise/denoiser.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "denoise/fake_library.h"
#include "prelight/error.h"

namespace prelight {
namespace {

using test::UsedLibrary;
using ::testing::HasSubstr;

/// One bright pixel in the middle of a picture of 5 x 5.
Picture brightPixel() {
  Picture picture{5, 5, std::vector<glm::vec3>(25, glm::vec3(0.0f))};
  picture.pixels[12] = {9.0f, 18.0f, 900.0f};
  return picture;
}

Guides guidesOf(const Picture& picture) {
  return {std::vector<glm::vec3>(picture.pixels.size(), glm::vec3(0.5f)),
          std::vector<glm::vec3>(picture.pixels.size(), glm::vec3(0.0f, 1.0f, 0.0f))};
}

template <typename Work>
std::string messageOf(ExitCode code, const Work& work) {
  try {
    work();
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), code) << error.what();
    return error.what();
  }
  ADD_FAILURE() << "nothing was thrown";
  return {};
}

TEST(Denoiser, Picture_IsFilteredWithItsGuides) {
  const UsedLibrary library(FAKE_OIDN);
  Denoiser denoiser({.threads = 3});
  EXPECT_EQ(denoiser.name(), "Open Image Denoise 2.5.1");
  EXPECT_EQ(denoiser.file(), FAKE_OIDN);
  const Picture noisy = brightPixel();
  const Picture clean = denoiser.denoise(noisy, guidesOf(noisy), DenoiseEffort::Full, Progress());
  ASSERT_EQ(clean.width, 5);
  ASSERT_EQ(clean.pixels.size(), 25u);
  for (int i = 0; i < 25; ++i) {
    const bool beside = std::abs(i % 5 - 2) <= 1 && std::abs(i / 5 - 2) <= 1;
    EXPECT_EQ(clean.pixels[std::size_t(i)], beside ? glm::vec3(1.0f, 2.0f, 100.0f) : glm::vec3(0.0f)) << i;
  }
  const std::string log = test::logOf(FAKE_OIDN);
  EXPECT_THAT(log, HasSubstr("device 1\n"));
  EXPECT_THAT(log, HasSubstr("device numThreads 3\n"));
  EXPECT_THAT(log, HasSubstr("device setAffinity 0\n"));
  EXPECT_THAT(log, HasSubstr("filter RT\nfilter hdr 1\n"));
  EXPECT_THAT(log,
              HasSubstr("image color 3 5x5\nimage albedo 3 5x5\nimage normal 3 5x5\nimage output 3 5x5\n"));
}

TEST(Denoiser, QuickPicture_FiltersGuidesWhereTheyAreNoisy) {
  const UsedLibrary library(FAKE_OIDN);
  const Picture noisy = brightPixel();
  Guides guides = guidesOf(noisy);
  const auto filters = [&] {
    Denoiser denoiser;
    const std::size_t before = test::logOf(FAKE_OIDN).size();
    const Picture clean = denoiser.denoise(noisy, guides, DenoiseEffort::Quick, Progress());
    EXPECT_EQ(clean.pixels[6], glm::vec3(1.0f, 2.0f, 100.0f));
    const std::string log = test::logOf(FAKE_OIDN).substr(before);
    EXPECT_THAT(log, HasSubstr("filter cleanAux 1\nfilter maxMemoryMB 1024\nfilter quality 5\n"));
    int count = 0;
    for (std::size_t at = log.find("filter RT\n"); at != std::string::npos;
         at = log.find("filter RT\n", at + 1))
      ++count;
    return count;
  };
  EXPECT_EQ(filters(), 3) << "noisy guides";
  guides.noisy = false;
  EXPECT_EQ(filters(), 1);
}

TEST(Denoiser, LightMaps_AreFilteredAsWhiteWallsAndAsDirections) {
  const UsedLibrary library(FAKE_OIDN);
  Denoiser denoiser;
  std::vector<glm::vec3> image = brightPixel().pixels;
  denoiser.denoise(LightMapQuantity::Light, 5, 5, image, Progress());
  EXPECT_EQ(image[6], glm::vec3(1.0f, 2.0f, 100.0f));
  EXPECT_THAT(test::logOf(FAKE_OIDN), HasSubstr("filter RT\nfilter hdr 1\nfilter cleanAux 1\n"));
  denoiser.denoise(LightMapQuantity::Directions, 5, 5, image, Progress());
  EXPECT_THAT(test::logOf(FAKE_OIDN), HasSubstr("filter RTLightmap\nfilter directional 1\n"));
}

TEST(Denoiser, ImagesOfOneSize_AreSetUpOnce) {
  const UsedLibrary library(FAKE_OIDN);
  Denoiser denoiser;
  const auto commits = [&] {
    const std::string log = test::logOf(FAKE_OIDN);
    int count = 0;
    for (std::size_t at = log.find("filter commit"); at != std::string::npos;
         at = log.find("filter commit", at + 1))
      ++count;
    return count;
  };
  std::vector<glm::vec3> image(12, glm::vec3(1.0f));
  denoiser.denoise(LightMapQuantity::Light, 4, 3, image, Progress());
  const int once = commits();
  denoiser.denoise(LightMapQuantity::Light, 4, 3, image, Progress());
  EXPECT_EQ(commits(), once);
  denoiser.denoise(LightMapQuantity::Light, 3, 4, image, Progress());
  EXPECT_EQ(commits(), once + 1);
}

TEST(Denoiser, NumbersThatAreNone_AreRefusedOnBothSides) {
  UsedLibrary library(FAKE_OIDN);
  Denoiser denoiser;
  Picture noisy = brightPixel();
  library.failWith("nan");
  std::vector<glm::vec3> image = noisy.pixels;
  const std::string made = messageOf(
      ExitCode::RuntimeFailure, [&] { denoiser.denoise(LightMapQuantity::Light, 5, 5, image, Progress()); });
  EXPECT_THAT(made, HasSubstr("its result at pixel (0, 0) is not finite"));
  EXPECT_EQ(image, noisy.pixels);
  noisy.pixels[7].y = std::numeric_limits<float>::infinity();
  const std::string given = messageOf(ExitCode::RuntimeFailure, [&] {
    denoiser.denoise(LightMapQuantity::Light, 5, 5, noisy.pixels, Progress());
  });
  EXPECT_THAT(given, HasSubstr("color at pixel (2, 1) is not finite"));
}

TEST(Denoiser, FailingFilter_IsReportedWithItsReason) {
  UsedLibrary library(FAKE_OIDN);
  Denoiser denoiser;
  std::vector<glm::vec3> image = brightPixel().pixels;
  const auto run = [&] { denoiser.denoise(LightMapQuantity::Light, 5, 5, image, Progress()); };
  library.failWith("filter");
  EXPECT_THAT(messageOf(ExitCode::RuntimeFailure, run),
              HasSubstr("Open Image Denoise failed: the fake fails"));
  library.failWith("memory");
  messageOf(ExitCode::OutOfMemory, run);
}

TEST(Denoiser, UserWhoStops_InterruptsTheFilter) {
  class Stopped final : public Progress {
    bool stopRequested() const override { return true; }
  };
  const UsedLibrary library(FAKE_OIDN);
  Denoiser denoiser;
  std::vector<glm::vec3> image = brightPixel().pixels;
  EXPECT_THROW(denoiser.denoise(LightMapQuantity::Light, 5, 5, image, Stopped()), Interrupted);
}

TEST(Denoiser, MissingLibrary_TellsHowToGetIt) {
  const UsedLibrary library("/nowhere/libOpenImageDenoise.so");
  const std::string message = messageOf(ExitCode::RuntimeFailure, [] { Denoiser(); });
  EXPECT_THAT(message, HasSubstr("PRELIGHT_OIDN_LIBRARY"));
  EXPECT_THAT(message, HasSubstr("/nowhere/libOpenImageDenoise.so"));
  EXPECT_THAT(message, HasSubstr("pip install pyoidn"));
}

TEST(Denoiser, OtherVersion_IsRefused) {
  const UsedLibrary library(FAKE_OIDN_OLDER);
  EXPECT_THAT(messageOf(ExitCode::RuntimeFailure, [] { Denoiser(); }),
              HasSubstr("is Open Image Denoise 1.4.3, expected version 2"));
}

TEST(Denoiser, LibraryWithoutAFunction_IsRefused) {
  const UsedLibrary library(FAKE_OIDN_INCOMPLETE);
  EXPECT_THAT(messageOf(ExitCode::RuntimeFailure, [] { Denoiser(); }),
              HasSubstr("no function oidnGetDeviceInt"));
}

TEST(Denoiser, ProcessorThatIsNotSupported_IsReported) {
  UsedLibrary library(FAKE_OIDN);
  library.failWith("device");
  EXPECT_THAT(messageOf(ExitCode::RuntimeFailure, [] { Denoiser(); }), HasSubstr("no processor"));
}

/// Tests with the real library, if PRELIGHT_OIDN_LIBRARY names it or the loader finds it.
class RealDenoiser : public ::testing::Test {
 protected:
  void SetUp() override {
    try {
      denoiser_ = std::make_unique<Denoiser>();
    } catch (const Error& error) {
      GTEST_SKIP() << error.what();
    }
  }

  std::unique_ptr<Denoiser> denoiser_;
};

/// A grey slope whose left half is darker, with and without noise.
struct NoisySlope {
  static constexpr int size = 96;
  Picture truth{size, size, {}};
  Picture noisy{size, size, {}};
  Guides guides;

  NoisySlope() {
    std::mt19937 random(7);
    std::exponential_distribution<float> light(1.0f);
    for (int i = 0; i < size * size; ++i) {
      const float value = (i % size < size / 2 ? 0.2f : 1.0f) * (1.0f + float(i / size) / size);
      truth.pixels.emplace_back(value);
      noisy.pixels.emplace_back(value * light(random));
      guides.albedo.emplace_back(i % size < size / 2 ? 0.1f : 0.5f);
      guides.normal.emplace_back(0.0f, 0.0f, 1.0f);
    }
  }

  double error(std::span<const glm::vec3> pixels) const {
    double sum = 0.0;
    for (std::size_t i = 0; i < pixels.size(); ++i)
      sum += std::pow(pixels[i].y / truth.pixels[i].y - 1.0f, 2.0);
    return sum / double(pixels.size());
  }
};

TEST_F(RealDenoiser, NoiseOfPictures_GoesAndEdgesStay) {
  const NoisySlope slope;
  const Picture clean = denoiser_->denoise(slope.noisy, slope.guides, DenoiseEffort::Full, Progress());
  EXPECT_LT(slope.error(clean.pixels), 0.01 * slope.error(slope.noisy.pixels));
}

TEST_F(RealDenoiser, NoiseOfLightMaps_Goes) {
  const NoisySlope slope;
  std::vector<glm::vec3> image = slope.noisy.pixels;
  denoiser_->denoise(LightMapQuantity::Light, slope.size, slope.size, image, Progress());
  EXPECT_LT(slope.error(image), 0.1 * slope.error(slope.noisy.pixels));
}

TEST_F(RealDenoiser, Result_DependsOnInputAloneNotOnThreads) {
  const NoisySlope slope;
  const Picture once = denoiser_->denoise(slope.noisy, slope.guides, DenoiseEffort::Full, Progress());
  const Picture again = denoiser_->denoise(slope.noisy, slope.guides, DenoiseEffort::Full, Progress());
  const Picture alone =
      Denoiser({.threads = 1}).denoise(slope.noisy, slope.guides, DenoiseEffort::Full, Progress());
  EXPECT_EQ(once.pixels, again.pixels);
  EXPECT_EQ(once.pixels, alone.pixels);
}

TEST_F(RealDenoiser, BlackPicture_StaysBlack) {
  Picture black{32, 32, std::vector<glm::vec3>(32 * 32, glm::vec3(0.0f))};
  const Picture clean = denoiser_->denoise(black, guidesOf(black), DenoiseEffort::Full, Progress());
  for (const glm::vec3& pixel : clean.pixels) EXPECT_LT(std::abs(pixel.x) + std::abs(pixel.y), 1e-3f);
}

}  // namespace
}  // namespace prelight
