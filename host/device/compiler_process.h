#pragma once

#include <functional>
#include <optional>
#include <string>

#include "prelight/device.h"
#include "processes/child_process.h"

namespace prelight {

/// A program to compile, with the compiler's options.
struct CompileJob {
  std::string options;
  std::string source;
};

/// Result of a job.
struct CompileAnswer {
  enum class Kind {
    Built,        ///< text: the binary; empty where the device gives none
    Refused,      ///< text: the build log
    Died,         ///< text: how the compiler ended, and its last words
    Killed,       ///< ended from outside, as systems do when memory is short
    Stopped,      ///< the caller stopped it
    Unavailable,  ///< no compiler process can be started: compile in this process
  };

  Kind kind = Kind::Unavailable;
  std::string text;
};

/// A prelight-compiler process (host/device/compiler_main.cpp), which compiles kernels for a device so that a
/// crash of the compiler does not end the program that bakes or draws. It starts with the first job and
/// serves later ones. Because it takes memory, it ends when no job has come for a while, and at the latest
/// with this object.
class CompilerProcess {
 public:
  explicit CompilerProcess(const DeviceInfo& device);

  /// Compiles a program and waits for it. Calls `goOn` ten times per second meanwhile; if that returns false,
  /// the compiler is ended and the answer is Stopped.
  CompileAnswer compile(const CompileJob& job, const std::function<bool()>& goOn);

 private:
  bool start(const std::function<bool()>& goOn);
  /// Sends a job and receives its answer. Returns false when the process has ended or `goOn` returned false.
  bool exchange(const CompileJob& job, const std::function<bool()>& goOn, std::string& answer);
  /// Waits for the next text. Returns false as exchange() does.
  bool await(const std::function<bool()>& goOn, std::string& text);
  CompileAnswer giveUp();
  /// Returns how the process ended, Unavailable if it ended by itself.
  CompileAnswer tellDeath();

  std::string device_;
  std::optional<ChildProcess> process_;
  bool stopped_ = false;
  bool unavailable_ = false;
};

}  // namespace prelight
