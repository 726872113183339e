// Replays the corpus and what fuzzing has found through the targets that libFuzzer calls (tests/fuzz/run).
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <string>
#include <vector>

#include "fuzz/target.h"
#include "prelight/error.h"

namespace prelight::fuzz {
namespace {

namespace fs = std::filesystem;

std::vector<fs::path> inputsOf(const char* kind, const Target& target) {
  std::vector<fs::path> files;
  const fs::path folder = fs::path(PRELIGHT_SOURCE_DIR) / "tests/fuzz" / kind / target.name;
  if (fs::exists(folder))
    for (const auto& entry : fs::directory_iterator(folder)) files.push_back(entry.path());
  std::ranges::sort(files);
  return files;
}

std::vector<std::uint8_t> bytesOf(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

class FuzzReplay : public ::testing::TestWithParam<Target> {};

TEST_P(FuzzReplay, Regressions_AreReadOrRefused) {
  for (const fs::path& file : inputsOf("regressions", GetParam()))
    EXPECT_NO_THROW(runTarget(GetParam(), bytesOf(file))) << file;
}

/// Seeds are right: they reach what lies behind the first check.
TEST_P(FuzzReplay, Corpus_IsRead) {
  const std::vector<fs::path> files = inputsOf("corpus", GetParam());
  EXPECT_FALSE(files.empty());
  for (const fs::path& file : files) EXPECT_NO_THROW(GetParam().read(bytesOf(file))) << file;
}

/// The begins of a seed are damaged seeds that need no fuzzer.
TEST_P(FuzzReplay, SeedsCutShort_AreReadOrRefused) {
  constexpr std::size_t cuts = 8;
  for (const fs::path& file : inputsOf("corpus", GetParam())) {
    const std::vector<std::uint8_t> bytes = bytesOf(file);
    for (std::size_t i = 0; i < cuts; ++i)
      EXPECT_NO_THROW(runTarget(GetParam(), Bytes(bytes).first(i * bytes.size() / cuts)))
          << file << " cut " << i;
  }
}

INSTANTIATE_TEST_SUITE_P(Targets, FuzzReplay, ::testing::ValuesIn(allTargets()),
                         [](const auto& target) { return std::string(target.param.name); });

/// An index beyond its array is reported, and an error of the library is not.
TEST(FuzzTarget, BrokenPromise_IsThrownOnAndErrorsAreNot) {
  EXPECT_THROW(runTarget({"a", [](Bytes) { require(false, "it holds"); }}, {}), std::logic_error);
  EXPECT_THROW(runTarget({"a", [](Bytes) { throw std::out_of_range("beyond"); }}, {}), std::out_of_range);
  EXPECT_NO_THROW(runTarget({"a", [](Bytes) { throw InputError("file", "is damaged"); }}, {}));
}

}  // namespace
}  // namespace prelight::fuzz
