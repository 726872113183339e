#pragma once

#include <chrono>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace prelight::test {

struct ProcessOptions {
  std::filesystem::path directory = {};                 ///< Working directory; empty means the caller's.
  std::map<std::string, std::string> environment = {};  ///< Variables added to the caller's.
  bool errorOnTerminal = false;                         ///< Makes stderr a pseudo-terminal instead of a pipe.
  /// Signal sent a moment after the first output on stdout.
  std::optional<int> signalAfterOutput = {};
};

struct ProcessResult {
  int exitCode = -1;  ///< Exit code, or 128 + signal if a signal ended the program.
  std::string output;
  std::string errors;
  double seconds = 0.0;
};

/// Runs a program to its end, without stdin.
ProcessResult runProcess(const std::vector<std::string>& command, const ProcessOptions& options = {});

}  // namespace prelight::test
