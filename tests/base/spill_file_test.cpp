#include "base/spill_file.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <vector>

#include "prelight/error.h"
#include "support/environment_variable.h"

namespace prelight {
namespace {

std::vector<std::byte> pattern(std::size_t size, unsigned seed) {
  std::vector<std::byte> bytes(size);
  for (std::size_t i = 0; i < size; ++i) bytes[i] = static_cast<std::byte>(i * 31 + seed);
  return bytes;
}

TEST(SpillFile, WrittenParts_AreReadBackInAnyOrder) {
  SpillFile file;
  file.write(5000, pattern(3000, 1));
  file.write(0, pattern(100, 2));
  std::vector<std::byte> read(3000);
  file.read(5000, read);
  EXPECT_EQ(read, pattern(3000, 1));
  read.resize(100);
  file.read(0, read);
  EXPECT_EQ(read, pattern(100, 2));
}

TEST(SpillFile, NeverWritten_ReadsAsZero) {
  SpillFile file;
  file.write(100, pattern(10, 1));
  std::vector<std::byte> read(200, std::byte{7});
  file.read(0, read);
  for (std::size_t i = 0; i < read.size(); ++i)
    EXPECT_EQ(read[i], i < 100 || i >= 110 ? std::byte{0} : pattern(10, 1)[i - 100]) << i;
}

TEST(SpillFile, WhileOpen_ShowsNoNameInItsFolder) {
  const std::filesystem::path folder = std::filesystem::path(testing::TempDir()) / "spill_file_folder";
  std::filesystem::remove_all(folder);
  std::filesystem::create_directories(folder);
  const test::EnvironmentVariable spillFolder("TMPDIR", folder.c_str());
  SpillFile file;
  file.write(0, pattern(10, 1));
  EXPECT_TRUE(std::filesystem::is_empty(folder));
}

TEST(SpillFile, MissingFolder_IsNamedWithWhatToDo) {
  const test::EnvironmentVariable spillFolder("TMPDIR", "/nowhere/at/all");
  try {
    const SpillFile file;
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::RuntimeFailure);
    const std::string text = error.what();
    EXPECT_NE(text.find("/nowhere/at/all"), std::string::npos) << text;
    EXPECT_NE(text.find("TMPDIR"), std::string::npos) << text;
  }
}

TEST(SpillFile, FullDisk_IsAnError) {
  // A size that no file system accepts stands in for a full disk.
  SpillFile file;
  EXPECT_THROW(file.write(std::uint64_t{1} << 62, pattern(10, 1)), Error);
}

}  // namespace
}  // namespace prelight
