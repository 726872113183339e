#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>

#include "prelight/error.h"
#include "prelight/picture.h"
#include "support/file_limit.h"
#include "support/gltf_files.h"

namespace prelight {
namespace {

namespace fs = std::filesystem;

std::string bytesOf(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

/// Noise, which no format can compress.
Picture noise(int size) {
  Picture picture{size, size, {}};
  std::uint32_t state = 1;
  for (int i = 0; i < size * size; ++i) {
    state = state * 1664525u + 1013904223u;
    picture.pixels.emplace_back(static_cast<float>(state >> 8) * 0x1p-24f);
  }
  return picture;
}

class FullDisk : public ::testing::TestWithParam<const char*> {
 protected:
  test::TemporaryFolder temporary_;
  fs::path folder_ = temporary_.path();
};

TEST_P(FullDisk, Picture_IsAnErrorAndTheOlderOneStays) {
  const fs::path path = folder_ / GetParam();
  writePicture(path, noise(4));
  const std::string before = bytesOf(path);
  {
    const test::FileLimit limit(2048);
    EXPECT_THROW(writePicture(path, noise(200)), Error);
  }
  EXPECT_EQ(bytesOf(path), before);
  EXPECT_EQ(std::distance(fs::directory_iterator(folder_), {}), 1) << "nothing else is left";
}

TEST_P(FullDisk, Layers_AreAnErrorAndTheOlderOnesStay) {
  const fs::path path = fs::path(folder_ / GetParam()).replace_extension(".exr");
  writePicture(path, noise(4), {{"variance.Y", std::vector<float>(16, 1.0f)}});
  const std::string before = bytesOf(path);
  {
    const test::FileLimit limit(2048);
    EXPECT_THROW(writePicture(path, noise(200), {{"variance.Y", std::vector<float>(40000, 1.0f)}}), Error);
  }
  EXPECT_EQ(bytesOf(path), before);
  EXPECT_EQ(std::distance(fs::directory_iterator(folder_), {}), 1);
}

INSTANTIATE_TEST_SUITE_P(Formats, FullDisk, ::testing::Values("a.png", "a.exr"));

}  // namespace
}  // namespace prelight
