#pragma once

#include <chrono>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace prelight::test {

struct ProcessOptions {
  std::filesystem::path directory = {};                 ///< working directory; empty: the caller's
  std::map<std::string, std::string> environment = {};  ///< added to the caller's
  bool errorOnTerminal = false;                         ///< stderr is a pseudo-terminal instead of a pipe
  std::optional<int> signalAfterOutput = {};            ///< sent a moment after the first output on stdout
};

struct ProcessResult {
  int exitCode = -1;  ///< 128 + signal when one ended it
  std::string output;
  std::string errors;
  double seconds = 0.0;
};

/// Runs a program to its end, without stdin.
ProcessResult runProcess(const std::vector<std::string>& command, const ProcessOptions& options = {});

}  // namespace prelight::test
