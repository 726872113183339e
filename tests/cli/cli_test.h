#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <vector>

#include "cli/subprocess.h"

namespace prelight::test {

/// Exit codes as documented in docs/command-line.md.
constexpr int failed = 1, badUsage = 2, badInput = 3, outOfMemory = 5, interrupted = 130;

/// Runs the built program in an empty folder of its own.
class CliTest : public ::testing::Test {
 protected:
  void SetUp() override;
  void TearDown() override;

  /// Runs `prelight ARGUMENTS...`.
  ProcessResult prelight(const std::vector<std::string>& arguments, ProcessOptions options = {}) const;

  /// Runs the program and expects exit code 0; shows its messages otherwise.
  ProcessResult prelightDone(const std::vector<std::string>& arguments, ProcessOptions options = {}) const;

  /// Expects the run to fail with `exitCode` and one error line that contains each of `parts`, without making
  /// or changing a file.
  void expectFailure(int exitCode, const std::vector<std::string>& arguments,
                     const std::vector<std::string>& parts, ProcessOptions options = {}) const;

  std::filesystem::path path(const std::string& name) const { return folder_ / name; }
  void writeFile(const std::string& name, const std::string& bytes) const;
  std::string readFile(const std::string& name) const;
  std::set<std::string> files() const;

 private:
  std::filesystem::path folder_;
};

}  // namespace prelight::test
