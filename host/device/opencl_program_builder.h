#pragma once

#include <filesystem>
#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <utility>

#include "device/compiler_process.h"
#include "device/context.h"
#include "device/opencl.h"
#include "device/program_cache.h"
#include "prelight/device.h"

namespace prelight {

/// Provides programs of kernels for a device: from the cache on disk, else from a compiler process, else,
/// where such a process is unavailable, from the compiler in this process.
class ProgramBuilder {
 public:
  ProgramBuilder(const cl::Context& context, const cl::Device& device, const DeviceInfo& info,
                 const DeviceOptions& options);

  /// Implements OpenClContext::program().
  const cl::Program& program(const std::string& file, const BuildOptions& options);

  /// Implements DeviceContext::addFile().
  void addFile(const std::string& file, const std::string& text);

  /// Seconds spent building or loading programs so far.
  double seconds() const;

 private:
  /// A program to build.
  struct Order {
    const std::string& file;
    std::string options;
    std::string source;
    std::string key;  ///< key in the cache
  };

  std::string expand(const std::string& file) const;
  cl::Program build(const Order& order);
  cl::Program compile(const Order& order);
  cl::Program compileHere(const Order& order);
  cl::Program fromBinary(const std::string& binary, const Order& order) const;
  Error refusal(const Order& order, const std::string& log) const;
  std::optional<std::string> fullFolder() const;
  Error death(const Order& order, const CompileAnswer& answer) const;

  cl::Context context_;
  cl::Device device_;
  DeviceInfo info_;
  ProgramCache cache_;
  CompilerProcess compiler_;
  std::filesystem::path dumpFolder_;
  bool portableKernels_;
  Progress* progress_;
  mutable std::mutex building_;  ///< overlapping stages request programs concurrently
  std::map<std::pair<std::string, std::string>, cl::Program> programs_;
  std::map<std::string, std::string> ownFiles_;
  double seconds_ = 0.0;
};

}  // namespace prelight
