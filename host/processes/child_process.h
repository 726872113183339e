#pragma once

#include <sys/types.h>

#include <filesystem>
#include <optional>
#include <string>

namespace prelight {

/// A program that the library has started to do work in its stead. Its standard input is one end of a socket,
/// its standard output is discarded, its standard error is kept in memory. It has no other files open, leaves
/// the signals that a terminal sends to its parent, and must end when it reads the end of the socket.
class ChildProcess {
 public:
  /// Returns nothing when the program cannot be started.
  static std::optional<ChildProcess> start(const std::filesystem::path& program);

  ChildProcess(ChildProcess&& other) noexcept;
  ChildProcess& operator=(ChildProcess&& other) noexcept;
  /// Kills the process.
  ~ChildProcess();
  ChildProcess(const ChildProcess&) = delete;
  ChildProcess& operator=(const ChildProcess&) = delete;

  /// The library's end of the socket.
  int channel() const { return channel_; }

  /// Returns whether the process has closed its end of the socket.
  bool hasLeft() const;

  /// Closes the socket, waits for the end of the process and returns its status as waitpid() does, or -1 if
  /// another part of the program has already collected it.
  int awaitEnd();

  /// Returns what the process has written to its standard error.
  std::string errors() const;

 private:
  ChildProcess() = default;

  pid_t process_ = -1;
  int channel_ = -1;
  int errors_ = -1;  ///< file in memory
};

}  // namespace prelight
