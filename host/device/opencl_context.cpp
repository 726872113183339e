#include "device/opencl_context.h"

#include <fmt/format.h>

#include <cstdlib>
#include <memory>

#include "device/opencl.h"
#include "prelight/error.h"

#ifdef __linux__
#include <sys/mman.h>
#endif

namespace prelight {

namespace {

/// Size of a huge page in bytes. Buffers of CPU devices from this size on lie on huge pages where the system
/// grants them, which saves a traversal most of its address translations.
constexpr std::size_t hugePageSize = std::size_t{2} << 20;

/// Allocates `bytes` rounded up to huge pages. Returns null when there is no memory. Release with
/// releaseHostMemory().
void* allocateHostMemory(std::size_t bytes) {
  const std::size_t rounded = (bytes + hugePageSize - 1) / hugePageSize * hugePageSize;
  void* memory = std::aligned_alloc(hugePageSize, rounded);
#ifdef __linux__
  // A refusal costs speed only.
  if (memory != nullptr) madvise(memory, rounded, MADV_HUGEPAGE);
#endif
  return memory;
}

void releaseHostMemory(void* memory) { std::free(memory); }

/// Allocates a buffer in host memory, which is released with the buffer.
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
      builder_(context_, device_, info_, options) {
  for (cl::CommandQueue& queue : queues_) queue = cl::CommandQueue(context_, device_);
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
    tellOfMissingMemory(error);
    if (isOutOfMemory(error) || error.err() == CL_INVALID_BUFFER_SIZE) throw fail();
    throw errorOf(error);
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
    tellOfMissingMemory(error);
    throw Error(isOutOfMemory(error) ? ExitCode::OutOfMemory : ExitCode::RuntimeFailure, info_.name,
                fmt::format("kernel {} failed to launch: {} ({})", kernel.getInfo<CL_KERNEL_FUNCTION_NAME>(),
                            error.what(), error.err()),
                whenDeviceFails);
  }
}

}  // namespace prelight
