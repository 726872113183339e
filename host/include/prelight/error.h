#pragma once

#include <stdexcept>
#include <string>
#include <vector>

namespace prelight {

/// Exit codes of the command line. An Error carries the one that it leads to.
enum class ExitCode : int {
  Done = 0,
  RuntimeFailure = 1,
  BadUsage = 2,
  BadInput = 3,
  NoDevice = 4,
  OutOfMemory = 5,
  Interrupted = 130,
};

/// A failure caused from outside: by a file, an option or a device. Bugs of the library are assertions
/// instead, and results that may be absent are std::optional.
///
/// `what()` reads "WHERE: WHAT (FIX)". WHERE is a file and JSON path, an option or a device; WHAT states the
/// actual and the expected value; FIX, which may be missing, says what to do.
class Error : public std::runtime_error {
 public:
  Error(ExitCode code, const std::string& where, const std::string& what, const std::string& fix = {});

  ExitCode code() const noexcept { return code_; }

  /// The parts of what(), for programs that show them separately.
  const std::string& where() const noexcept { return where_; }
  const std::string& problem() const noexcept { return problem_; }
  const std::string& fix() const noexcept { return fix_; }  ///< may be empty

 private:
  ExitCode code_;
  std::string where_;
  std::string problem_;
  std::string fix_;
};

/// A file that cannot be read as what it claims to be. `where` is "FILE" or "FILE: /json/path".
class InputError : public Error {
 public:
  explicit InputError(const std::string& where, const std::string& what, const std::string& fix = {})
      : Error(ExitCode::BadInput, where, what, fix) {}
};

/// A command, option or value that the program does not take.
class UsageError : public Error {
 public:
  explicit UsageError(const std::string& where, const std::string& what, const std::string& fix = {})
      : Error(ExitCode::BadUsage, where, what, fix) {}
};

/// The user pressed Ctrl-C (or sent SIGTERM) and the work stopped at a safe point.
class Interrupted : public Error {
 public:
  explicit Interrupted(const std::string& what = "interrupted; no output was written")
      : Error(ExitCode::Interrupted, "prelight", what) {}
};

/// Messages about odd but usable input. Each names the place in the input.
using Warnings = std::vector<std::string>;

}  // namespace prelight
