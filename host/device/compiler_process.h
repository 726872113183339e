#pragma once

#include <sys/types.h>

#include <functional>
#include <string>

#include "prelight/device.h"

namespace prelight {

/// A program to compile, and what is asked of the compiler.
struct CompileJob {
  std::string options;
  std::string source;
};

/// What became of a job.
struct CompileAnswer {
  enum class Kind {
    Built,        ///< text: the binary; empty where the device gives none
    Refused,      ///< text: the build log
    Died,         ///< text: how the compiler ended, and its last words
    Killed,       ///< from outside, as systems do when memory is short
    Stopped,      ///< the caller gave up
    Unavailable,  ///< no such process can be had: compile in this one
  };

  Kind kind = Kind::Unavailable;
  std::string text;
};

/// The program prelight-compiler (host/device/compiler_main.cpp), in which kernels are compiled for a device,
/// so that a compiler that crashes does not end the program that bakes or draws. It starts with a job, serves
/// those that follow, ends when none has come for a while, as it takes memory, and at the latest with this
/// object.
class CompilerProcess {
 public:
  explicit CompilerProcess(const DeviceInfo& device);
  ~CompilerProcess();
  CompilerProcess(const CompilerProcess&) = delete;
  CompilerProcess& operator=(const CompilerProcess&) = delete;

  /// Compiles a program and waits for it. Calls `goOn` ten times a second meanwhile; where that returns
  /// false, the compiler is ended and the answer is Stopped.
  CompileAnswer compile(const CompileJob& job, const std::function<bool()>& goOn);

 private:
  bool start(const std::function<bool()>& goOn);
  /// True when the process has ended since its last job, having had nothing to do.
  bool hasLeft() const;
  /// Returns false when the process is gone, or `goOn` returned false.
  bool exchange(const CompileJob& job, const std::function<bool()>& goOn, std::string& answer);
  bool spawn(const std::string& program, int channel, int errors);
  /// Waits for the next text. Returns false as exchange() does.
  bool await(const std::function<bool()>& goOn, std::string& text);
  CompileAnswer giveUp();
  /// Says how the process ended; Unavailable where it did so by itself.
  CompileAnswer tellDeath();
  void end();

  std::string device_;
  pid_t process_ = -1;
  int channel_ = -1;
  int errors_ = -1;  ///< a file in memory with what the process wrote on stderr
  bool busy_ = false;
  bool stopped_ = false;
  bool unavailable_ = false;
};

}  // namespace prelight
