#include "device/opencl_context.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <fstream>
#include <memory>

#include "device/host_memory.h"
#include "device/kernel_source.h"
#include "device/kernel_sources.h"
#include "device/opencl_errors.h"
#include "prelight/error.h"

namespace prelight {

namespace {

std::filesystem::path cacheFolder(const DeviceOptions& options) {
  // On PoCL, too: its own cache knows a program only after the compiler has read it, some 30 ms each.
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

/// A buffer in memory of the host, which it gives back when it is released.
cl::Buffer allocateOnHugePages(const cl::Context& context, cl_mem_flags flags, std::size_t bytes) {
  std::unique_ptr<void, void (*)(void*)> memory(allocateHostMemory(bytes), releaseHostMemory);
  if (!memory) throw cl::Error(CL_OUT_OF_HOST_MEMORY, "aligned_alloc");
  cl::Buffer buffer(context, flags | CL_MEM_USE_HOST_PTR, bytes, memory.get());
  buffer.setDestructorCallback([](cl_mem, void* owned) { releaseHostMemory(owned); }, memory.get());
  memory.release();
  return buffer;
}

}  // namespace

OpenClContext::OpenClContext(const cl::Device& device, DeviceInfo info, const DeviceOptions& options)
    : device_(device),
      info_(std::move(info)),
      context_(device_),
      cache_(cacheFolder(options)),
      dumpFolder_(options.dumpKernels),
      portableKernels_(options.portableKernels) {
  for (cl::CommandQueue& queue : queues_) queue = cl::CommandQueue(context_, device_);
}

const cl::Program& OpenClContext::program(const std::string& file, const BuildOptions& wanted) {
  const BuildOptions options = BuildOptions(wanted).defineIf(portableKernels_, "PRELIGHT_PORTABLE_LANES");
  const std::string text = options.text() + " -cl-kernel-arg-info";  // typed kernels ask for it
  const auto key = std::make_pair(file, text);
  if (const auto found = programs_.find(key); found != programs_.end()) return found->second;
  const auto start = std::chrono::steady_clock::now();
  const std::string source = expand(file);
  if (!dumpFolder_.empty()) dump(dumpFolder_, file, source, text);
  const auto& built = programs_.emplace(key, build(file, source, text)).first->second;
  buildSeconds_ += std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return built;
}

std::string OpenClContext::expand(const std::string& file) const {
  if (!ownFiles_.contains(file)) return expandKernelSource(file, kernelSources());
  std::map<std::string, std::string> sources = kernelSources();
  sources.insert(ownFiles_.begin(), ownFiles_.end());
  return expandKernelSource(file, sources);
}

cl::Program OpenClContext::build(const std::string& file, const std::string& source,
                                 const std::string& options) {
  const std::string key = sha256(fmt::format("{}\n{}\n{}\n{}\n{}\n{}", source, options, info_.name,
                                             info_.vendor, info_.driverVersion, info_.platformVersion));
  if (const auto binary = cache_.load(key)) {
    try {
      cl::Program program(context_, {device_}, cl::Program::Binaries{*binary});
      program.build({device_}, options.c_str());
      return program;
    } catch (const cl::Error&) {
      cache_.remove(key);  // a driver may refuse what it wrote earlier: rebuild from source
    }
  }
  cl::Program program(context_, source);
  try {
    program.build({device_}, options.c_str());
  } catch (const cl::Error&) {
    const std::string log = program.getBuildInfo<CL_PROGRAM_BUILD_LOG>(device_);
    throw Error(ExitCode::RuntimeFailure, file,
                fmt::format("the kernel does not build on {} with {}:\n{}", info_.name, options,
                            nameSourceFiles(log, source)));
  }
  const auto binaries = program.getInfo<CL_PROGRAM_BINARIES>();
  if (!binaries.empty() && !binaries.front().empty()) cache_.store(key, binaries.front());
  return program;
}

cl::Buffer OpenClContext::allocate(std::size_t bytes, cl_mem_flags flags) {
  const auto fail = [&] {
    return Error(ExitCode::OutOfMemory, info_.name,
                 fmt::format("cannot hold a buffer of {:.1f} MiB, at most {:.1f} MiB",
                             double(bytes) / (1 << 20), double(info_.maxAllocation) / (1 << 20)),
                 "choose another DeviceOptions::selector, a lower Effort::rays or BakeRequest::maxMemory");
  };
  if (bytes > info_.maxAllocation) throw fail();
  bytes_ += bytes;
  try {
    if (info_.kind == DeviceKind::Cpu && bytes >= hugePageSize)
      return allocateOnHugePages(context_, flags, bytes);
    return cl::Buffer(context_, flags, bytes);
  } catch (const cl::Error& error) {
    if (isOutOfMemory(error) || error.err() == CL_INVALID_BUFFER_SIZE) throw fail();
    throw;
  }
}

void OpenClContext::launch(const cl::Kernel& kernel, std::size_t items, std::size_t groupSize,
                           DeviceLane lane) {
  if (items == 0) return;
  const std::size_t rounded = (items + groupSize - 1) / groupSize * groupSize;
  ++launches_;
  workItems_ += items;
  try {
    queue(lane).enqueueNDRangeKernel(kernel, cl::NullRange, cl::NDRange(rounded), cl::NDRange(groupSize));
  } catch (const cl::Error& error) {
    throw Error(isOutOfMemory(error) ? ExitCode::OutOfMemory : ExitCode::RuntimeFailure, info_.name,
                fmt::format("kernel {} failed to launch: {} ({})", kernel.getInfo<CL_KERNEL_FUNCTION_NAME>(),
                            error.what(), error.err()));
  }
}

}  // namespace prelight
