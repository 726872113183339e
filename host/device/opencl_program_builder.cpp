#include "device/opencl_program_builder.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <fstream>
#include <optional>
#include <vector>

#include "device/kernel_source.h"
#include "device/opencl.h"
#include "device/opencl_devices.h"
#include "device/pocl.h"
#include "device/thread_check.h"
#include "prelight/error.h"

namespace prelight {

namespace {

using Clock = std::chrono::steady_clock;

double secondsSince(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

std::filesystem::path cacheFolder(const DeviceOptions& options) {
  // The cache also helps with PoCL, whose own cache identifies a program only after compiling its source to
  // an intermediate form, some 30 ms per program.
  return options.cacheKernels.value_or(true) ? ProgramCache::defaultFolder() : std::filesystem::path();
}

void dump(const std::filesystem::path& folder, const std::string& file, const std::string& source,
          const std::string& options) {
  std::string name = file;
  std::replace(name.begin(), name.end(), '/', '_');
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  const std::filesystem::path path = folder / fmt::format("{}_{}", sha256(options).substr(0, 8), name);
  std::ofstream out(path);
  out << "// " << options << '\n' << source;
  if (out.flush()) return;
  out.close();
  std::filesystem::remove(path, error);
  throw Error(ExitCode::RuntimeFailure, "DeviceOptions::dumpKernels " + folder.string(),
              "cannot write the kernel sources", "check its permissions and free space");
}

std::string binaryOf(const cl::Program& program) {
  const auto binaries = program.getInfo<CL_PROGRAM_BINARIES>();
  if (binaries.empty()) return {};
  return {binaries.front().begin(), binaries.front().end()};
}

/// Reports the compilation of a program to a progress.
class Teller {
 public:
  Teller(Progress* progress, const std::string& file) : progress_(progress), file_(file) { tell(); }

  /// Reports the current state. Returns false when the user has asked to stop.
  bool tell(bool finished = false) const {
    if (progress_ == nullptr) return true;
    progress_->compiling({file_, secondsSince(start_), finished});
    return !progress_->stopRequested();
  }

 private:
  Progress* progress_;
  const std::string& file_;
  Clock::time_point start_ = Clock::now();
};

}  // namespace

ProgramBuilder::ProgramBuilder(const cl::Context& context, const cl::Device& device, const DeviceInfo& info,
                               const DeviceOptions& options)
    : context_(context),
      device_(device),
      info_(info),
      cache_(cacheFolder(options)),
      compiler_(info),
      dumpFolder_(options.dumpKernels),
      portableKernels_(options.portableKernels),
      progress_(options.progress) {}

const cl::Program& ProgramBuilder::program(const std::string& file, const BuildOptions& wanted) {
  const BuildOptions options = BuildOptions(wanted).defineIf(portableKernels_, "PRELIGHT_PORTABLE_LANES");
  // Typed kernels query their arguments. -w silences Clang, which prints a count of warnings on stderr.
  const std::string text = options.text() + " -w -cl-kernel-arg-info";
  const auto key = std::make_pair(file, text);
  const std::lock_guard lock(building_);
  if (const auto found = programs_.find(key); found != programs_.end()) return found->second;
  const Clock::time_point start = Clock::now();
  const std::string source = expand(file);
  if (!dumpFolder_.empty()) dump(dumpFolder_, file, source, text);
  const Order order{file, text, source, sha256(source + '\n' + text + '\n' + identityOf(info_))};
  const auto& built = programs_.emplace(key, build(order)).first->second;
  seconds_ += secondsSince(start);
  return built;
}

void ProgramBuilder::addFile(const std::string& file, const std::string& text) {
  const std::lock_guard lock(building_);
  ownFiles_[file] = text;
}

double ProgramBuilder::seconds() const {
  const std::lock_guard lock(building_);
  return seconds_;
}

std::string ProgramBuilder::expand(const std::string& file) const {
  if (!ownFiles_.contains(file)) return expandKernelSource(file, kernelSources());
  std::map<std::string, std::string> sources = kernelSources();
  sources.insert(ownFiles_.begin(), ownFiles_.end());
  return expandKernelSource(file, sources);
}

cl::Program ProgramBuilder::build(const Order& order) {
  if (const auto binary = cache_.load(order.key)) {
    try {
      return fromBinary({binary->begin(), binary->end()}, order);
    } catch (const cl::Error&) {
      cache_.remove(order.key);  // a driver may refuse binaries that it wrote earlier: rebuild from source
    }
  }
  return compile(order);
}

cl::Program ProgramBuilder::compile(const Order& order) {
  const Teller teller(progress_, order.file);
  const CompileAnswer answer =
      compiler_.compile({order.options, order.source}, [&] { return teller.tell(); });
  std::optional<cl::Program> program;
  switch (answer.kind) {
    case CompileAnswer::Kind::Refused:
      throw refusal(order, answer.text);
    case CompileAnswer::Kind::Died:
    case CompileAnswer::Kind::Killed:
      throw death(order, answer);
    case CompileAnswer::Kind::Stopped:
      throw Interrupted();
    case CompileAnswer::Kind::Built:
      try {
        if (!answer.text.empty()) program = fromBinary(answer.text, order);
      } catch (const cl::Error&) {
        // A driver that accepts no binaries gets the source.
      }
      break;
    case CompileAnswer::Kind::Unavailable:
      break;
  }
  if (program)
    cache_.store(order.key, {answer.text.begin(), answer.text.end()});
  else
    program = compileHere(order);
  teller.tell(true);
  return *program;
}

cl::Program ProgramBuilder::compileHere(const Order& order) {
  cl::Program program(context_, order.source);
  try {
    buildProgram(program, device_, info_, order.options);
  } catch (const cl::Error&) {
    throw refusal(order, program.getBuildInfo<CL_PROGRAM_BUILD_LOG>(device_));
  }
  if (const std::string binary = binaryOf(program); !binary.empty())
    cache_.store(order.key, {binary.begin(), binary.end()});
  return program;
}

cl::Program ProgramBuilder::fromBinary(const std::string& binary, const Order& order) const {
  cl::Program program(context_, {device_},
                      cl::Program::Binaries{std::vector<unsigned char>(binary.begin(), binary.end())});
  buildProgram(program, device_, info_, order.options);
  return program;
}

Error ProgramBuilder::refusal(const Order& order, const std::string& log) const {
  return {ExitCode::RuntimeFailure, order.file,
          fmt::format("the kernel does not build on {} with {}:\n{}", info_.name, order.options,
                      nameSourceFiles(log, order.source)),
          fullFolder().value_or("")};
}

/// Returns a message if the disk of PoCL's cache is full, which compilers do not report.
std::optional<std::string> ProgramBuilder::fullFolder() const {
  const std::optional<std::string> problem = info_.isPocl ? problemOfPoclCache() : std::nullopt;
  if (!problem) return std::nullopt;
  return *problem + "; free space there, or set POCL_CACHE_DIR to another folder";
}

Error ProgramBuilder::death(const Order& order, const CompileAnswer& answer) const {
  const std::string compiler = fmt::format("the compiler of {} {}", info_.platform, info_.driverVersion);
  if (answer.kind == CompileAnswer::Kind::Killed)
    return {ExitCode::OutOfMemory, order.file, compiler + " was killed, as systems do when memory is short",
            "close other programs, or give this one more memory"};
  if (addressSpaceIsLimited())
    return {ExitCode::OutOfMemory, order.file,
            fmt::format("{} crashed in a limited address space; {}", compiler, answer.text),
            "raise the limit with ulimit -v"};
  const std::string otherWays =
      info_.isPocl ? "try POCL_WORK_GROUP_METHOD=loopvec or cbs, which make PoCL compile in another way, "
                     "another version of PoCL, or another DeviceOptions::selector"
                   : "update the driver, or choose another DeviceOptions::selector";
  return {ExitCode::RuntimeFailure, order.file,
          fmt::format("{} crashed on these kernels for {} with {}; {}", compiler, info_.name, order.options,
                      answer.text),
          fullFolder().value_or(otherWays)};
}

}  // namespace prelight
