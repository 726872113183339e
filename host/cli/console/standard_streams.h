#pragma once

#include <string_view>
#include <system_error>

namespace prelight::cli {

/// Opens those of stdin, stdout and stderr that the caller has closed, so that no other file gets their
/// numbers. Writing to them still fails. Must be called before anything opens a file.
void openStandardStreams();

/// Writes to stderr. Text that cannot be written is lost, as there is nobody left to tell.
void writeError(std::string_view text);

/// Standard output that remembers its first failure, after which the result is lost and later text is
/// dropped.
class StandardOutput {
 public:
  /// Writes at once, so that readers of a pipe see the text immediately.
  void write(std::string_view text);

  /// Returns why text was lost; none if a reader has closed its end of the pipe because it had enough.
  std::error_code failure() const;

 private:
  std::error_code failure_;
};

}  // namespace prelight::cli
