#pragma once

#include <filesystem>
#include <iosfwd>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "cli/subprocess.h"

namespace prelight::test {

/// A command to try; `@` stands for the folder of inputs.
struct Command {
  const char* name;
  const char* arguments;
  std::set<std::string> outputs;  ///< Files, or folders of files.
};

void PrintTo(const Command& command, std::ostream* out);

/// Commands that together use every part of the program that computes or writes.
const std::vector<Command>& everyCommand();

/// A temporary folder with the inputs of commands, in which they run.
class CommandRuns {
 public:
  using Environment = std::map<std::string, std::string>;

  CommandRuns();
  CommandRuns(const CommandRuns&) = delete;
  CommandRuns& operator=(const CommandRuns&) = delete;
  ~CommandRuns();

  /// Makes the scenes, pictures and parts that commands read. Returns what went wrong, or nothing.
  std::string makeInputs(const Environment& environment);

  /// Runs a command in a folder that is emptied before.
  ProcessResult run(const std::string& arguments, const Environment& environment) const;

  /// Returns the files of the last command by their paths below its folder, without times, in which equal
  /// runs differ.
  std::map<std::string, std::string> outputs() const;

  const std::filesystem::path& folder() const { return folder_; }

 private:
  std::filesystem::path folder_;
};

std::string textOf(const std::filesystem::path& path);

}  // namespace prelight::test
