#pragma once

#include <string_view>
#include <system_error>

namespace prelight::cli {

/// Opens what a caller has closed of stdin, stdout and stderr, so that no file gets its number and is taken
/// for it. Writing to what was closed still fails. Call it before anything opens a file.
void openStandardStreams();

/// Writes to stderr. What cannot be written is lost: there is nobody left to tell.
void writeError(std::string_view text);

/// stdout, which a result is lost with: the first failure is kept, later text is dropped.
class StandardOutput {
 public:
  /// Whoever reads a pipe sees it at once.
  void write(std::string_view text);

  /// Why the first text was lost; none for a reader that closed its end of a pipe, as it has what it wanted.
  std::error_code failure() const;

 private:
  std::error_code failure_;
};

}  // namespace prelight::cli
