#include "device/device_memory.h"

#include "device/opencl.h"
#include "device/opencl_context.h"

namespace prelight {

DeviceMemory::DeviceMemory(DeviceContext& device, std::size_t bytes, bool readOnly, DeviceLane lane)
    : opencl_(std::make_unique<OpenCl>(
          OpenCl{device.opencl().queue(lane),
                 device.opencl().allocate(bytes, readOnly ? CL_MEM_READ_ONLY : CL_MEM_READ_WRITE)})) {}

DeviceMemory::~DeviceMemory() = default;

void DeviceMemory::write(const void* data, std::size_t bytes, std::size_t at) {
  calling([&] { opencl_->queue.enqueueWriteBuffer(opencl_->buffer, CL_TRUE, at, bytes, data); });
}

void DeviceMemory::read(void* data, std::size_t bytes, std::size_t at) const {
  calling([&] { opencl_->queue.enqueueReadBuffer(opencl_->buffer, CL_TRUE, at, bytes, data); });
}

const void* DeviceMemory::mapToRead(std::size_t bytes) const {
  return calling(
      [&] { return opencl_->queue.enqueueMapBuffer(opencl_->buffer, CL_TRUE, CL_MAP_READ, 0, bytes); });
}

void* DeviceMemory::mapToOverwrite(std::size_t bytes) {
  return calling([&] {
    return opencl_->queue.enqueueMapBuffer(opencl_->buffer, CL_TRUE, CL_MAP_WRITE_INVALIDATE_REGION, 0,
                                           bytes);
  });
}

void DeviceMemory::unmap(const void* mapped) const noexcept {
  // A failure to queue the command is reported by the next command.
  (void)clEnqueueUnmapMemObject(opencl_->queue(), opencl_->buffer(), const_cast<void*>(mapped), 0, nullptr,
                                nullptr);
}

void DeviceMemory::fill(const void* pattern, std::size_t patternBytes, std::size_t bytes) {
  // The C function is used because the C++ bindings take patterns by their type only.
  const cl_int status = clEnqueueFillBuffer(opencl_->queue(), opencl_->buffer(), pattern, patternBytes, 0,
                                            bytes, 0, nullptr, nullptr);
  calling([&] {
    if (status != CL_SUCCESS) throw cl::Error(status, "clEnqueueFillBuffer");
  });
}

void DeviceMemory::copy(const DeviceMemory& from, std::size_t bytes) {
  calling([&] { opencl_->queue.enqueueCopyBuffer(from.opencl_->buffer, opencl_->buffer, 0, 0, bytes); });
}

void* DeviceMemory::handle() const { return opencl_->buffer(); }

}  // namespace prelight
