#pragma once

#include <span>
#include <type_traits>
#include <vector>

#include "device/context.h"
#include "device/opencl.h"

namespace prelight {

/// A device buffer of `size()` elements of a shared struct or scalar. Never empty on the device: OpenCL has
/// no buffer of 0 bytes, so an empty one holds a dummy element.
template <typename T>
class Buffer {
  static_assert(std::is_trivially_copyable_v<T>);

 public:
  Buffer() = default;

  Buffer(DeviceContext& device, std::size_t size, cl_mem_flags flags = CL_MEM_READ_WRITE)
      : queue_(device.queue()), size_(size), buffer_(device.allocate(bytesOf(size), flags)) {}

  Buffer(DeviceContext& device, std::span<const T> data) : Buffer(device, data.size(), CL_MEM_READ_ONLY) {
    write(data);
  }

  std::size_t size() const { return size_; }
  std::size_t bytes() const { return bytesOf(size_); }
  const cl::Buffer& get() const { return buffer_; }

  /// Copies `data` to the buffer's elements from `first` on and waits.
  void write(std::span<const T> data, std::size_t first = 0) {
    if (!data.empty())
      queue_.enqueueWriteBuffer(buffer_, CL_TRUE, first * sizeof(T), data.size_bytes(), data.data());
  }

  /// Copies elements from `first` on into `data` and waits.
  void read(std::span<T> data, std::size_t first = 0) const {
    if (!data.empty())
      queue_.enqueueReadBuffer(buffer_, CL_TRUE, first * sizeof(T), data.size_bytes(), data.data());
  }

  std::vector<T> read() const {
    std::vector<T> data(size_);
    read(std::span<T>(data));
    return data;
  }

  void fill(const T& value) { queue_.enqueueFillBuffer(buffer_, value, 0, bytesOf(size_)); }

 private:
  static std::size_t bytesOf(std::size_t size) { return (size == 0 ? 1 : size) * sizeof(T); }

  cl::CommandQueue queue_;
  std::size_t size_ = 0;
  cl::Buffer buffer_;
};

}  // namespace prelight
