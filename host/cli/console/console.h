#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <utility>

#include "cli/console/global_options.h"
#include "cli/console/standard_streams.h"
#include "prelight/error.h"

namespace prelight::cli {

/// Prints for people and programs: results on stdout (as text, or as JSON with --json), everything else on
/// stderr. No function throws if a stream takes no text; StandardOutput remembers that. Text from files is
/// made harmless for terminals (cli/console/printable.h).
class Console {
 public:
  /// `output` must outlive the console.
  Console(GlobalOptions options, StandardOutput& output) : options_(std::move(options)), output_(output) {}

  bool textWanted() const { return !options_.quiet && !options_.json; }
  bool detailsWanted() const { return textWanted() && options_.verbose; }
  bool jsonWanted() const { return options_.json; }

  /// Prints a line of the result, a label and a text. Prints nothing with --quiet or --json.
  void line(std::string_view label, std::string_view text) const;

  /// Prints the result for programs, only with --json.
  void json(const nlohmann::ordered_json& result) const;

  /// Says on stderr what was done without being asked for. Prints nothing with --quiet.
  void note(std::string_view text) const;

  /// Prints warnings on stderr, only the first few without --verbose, none with --quiet.
  void warn(const Warnings& warnings) const;

 private:
  GlobalOptions options_;
  StandardOutput& output_;
};

/// Returns whether a stream is a terminal that may be sent control sequences, which NO_COLOR forbids.
bool mayColor(int fileDescriptor);

/// Writes "prelight: error: TEXT" to stderr.
void printError(std::string_view text);

/// Counts and sizes for people, such as "9.8 k" and "10.2 M".
std::string shortCount(double value);
std::string shortBytes(double bytes);
std::string shortSeconds(double seconds);

}  // namespace prelight::cli
