#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

/// The program's commands and options as plain data, read from the argument parser. The manual page and the
/// completions are made from this table, so that no option is described twice.
namespace prelight::cli {

struct OptionRow {
  /// Such as "-o", "--output"; for a positional argument the name that help gives it
  std::vector<std::string> names;
  std::string value;  ///< name of its value in help; empty: it takes none
  std::string purpose;
  bool named = true;  ///< false: a positional argument
  bool required = false;
  bool repeats = false;
};

struct CommandRow {
  std::string name, purpose;
  std::string examples;            ///< examples at the end of its help
  std::vector<OptionRow> options;  ///< without --help
};

struct CommandTable {
  std::string purpose;
  std::vector<OptionRow> options;  ///< options that every command takes, with --help and --version
  std::vector<CommandRow> commands;
};

CommandTable commandTable(const CLI::App& program);

}  // namespace prelight::cli
