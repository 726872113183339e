#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

/// The program's commands and options as plain data, read out of what parses them: manual page and
/// completions are made of it, so that none of them is written twice.
namespace prelight::cli {

struct OptionRow {
  std::vector<std::string> names;  ///< "-o", "--output"; of an argument that has no name how help calls it
  std::string value;               ///< what follows it, as help calls it; empty: nothing
  std::string purpose;
  bool named = true;  ///< it is known by its name, not by its place
  bool required = false;
  bool repeats = false;
};

struct CommandRow {
  std::string name, purpose;
  std::string examples;            ///< what help ends with
  std::vector<OptionRow> options;  ///< without --help
};

struct CommandTable {
  std::string purpose;
  std::vector<OptionRow> options;  ///< that every command takes; --help and --version too
  std::vector<CommandRow> commands;
};

CommandTable commandTable(const CLI::App& program);

}  // namespace prelight::cli
