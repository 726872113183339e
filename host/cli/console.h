#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <utility>

#include "cli/global_options.h"
#include "cli/standard_streams.h"
#include "prelight/error.h"

namespace prelight::cli {

/// What people and programs read: results on stdout (text, or JSON with --json), everything else on stderr.
/// Nothing here throws when a stream takes no text; StandardOutput knows. What text from files could do to a
/// terminal is taken from it (cli/printable.h).
class Console {
 public:
  /// `output` outlives it.
  Console(GlobalOptions options, StandardOutput& output) : options_(std::move(options)), output_(output) {}

  bool textWanted() const { return !options_.quiet && !options_.json; }
  bool detailsWanted() const { return textWanted() && options_.verbose; }
  bool jsonWanted() const { return options_.json; }

  /// A line of the result: a label and what there is to say. Nothing with --quiet or --json.
  void line(std::string_view label, std::string_view text) const;

  /// The machine-readable result, with --json only.
  void json(const nlohmann::ordered_json& result) const;

  /// Something that was done without being asked for, on stderr. Nothing with --quiet.
  void note(std::string_view text) const;

  /// Warnings on stderr, the first few unless --verbose asks for all. Nothing with --quiet.
  void warn(const Warnings& warnings) const;

 private:
  GlobalOptions options_;
  StandardOutput& output_;
};

/// True when a stream is a terminal on which control sequences may be written (NO_COLOR is not set).
bool mayColor(int fileDescriptor);

/// Writes "prelight: error: TEXT" to stderr.
void printError(std::string_view text);

/// "9.8 k", "10.2 M": counts in text meant for people.
std::string shortCount(double value);
std::string shortBytes(double bytes);
std::string shortSeconds(double seconds);

}  // namespace prelight::cli
