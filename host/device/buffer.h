#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <type_traits>
#include <vector>

#include "device/device_memory.h"

namespace prelight {

/// Elements of a buffer mapped into host memory while this object lives. No command may use them meanwhile.
template <typename T>
class MappedElements {
 public:
  MappedElements(const DeviceMemory& memory, T* first, std::size_t count)
      : memory_(memory), elements_(first, count) {}
  MappedElements(const MappedElements&) = delete;
  MappedElements& operator=(const MappedElements&) = delete;
  ~MappedElements() { memory_.unmap(elements_.data()); }

  T& operator[](std::size_t index) const { return elements_[index]; }

 private:
  const DeviceMemory& memory_;
  std::span<T> elements_;
};

/// A device buffer of `size()` elements of a shared struct or scalar. Copies share the elements. OpenCL has
/// no buffers of 0 bytes, so an empty one holds a dummy element.
template <typename T>
class Buffer {
  static_assert(std::is_trivially_copyable_v<T>);

 public:
  /// Makes a buffer without any memory.
  Buffer() = default;

  /// Makes a buffer whose copies, reads and fills are commands of `lane`.
  Buffer(DeviceContext& device, std::size_t size, DeviceLane lane = {}) : Buffer(device, size, false, lane) {}

  /// Makes a buffer with a copy of `data`, which kernels only read.
  Buffer(DeviceContext& device, std::span<const T> data) : Buffer(device, data.size(), true, {}) {
    write(data);
  }

  std::size_t size() const { return size_; }
  std::size_t bytes() const { return bytesOf(size_); }

  /// Returns the memory, or nullptr for a buffer made by the default constructor.
  const DeviceMemory* memory() const { return memory_.get(); }

  /// Copies `data` to the buffer's elements from `first` on and waits.
  void write(std::span<const T> data, std::size_t first = 0) { writeArray(data, first); }

  /// Copies the bytes of an array of another type to where element `first` starts, and waits.
  template <typename U>
  void writeArray(std::span<const U> array, std::size_t first) {
    static_assert(std::is_trivially_copyable_v<U>);
    if (!array.empty()) memory_->write(array.data(), array.size_bytes(), first * sizeof(T));
  }

  /// Copies elements from `first` on into `data` and waits.
  void read(std::span<T> data, std::size_t first = 0) const {
    if (!data.empty()) memory_->read(data.data(), data.size_bytes(), first * sizeof(T));
  }

  std::vector<T> read() const {
    std::vector<T> data(size_);
    read(std::span<T>(data));
    return data;
  }

  /// Maps the first `count` > 0 elements for reading, in place or as a copy.
  MappedElements<const T> mapped(std::size_t count) const {
    return {*memory_, static_cast<const T*>(memory_->mapToRead(count * sizeof(T))), count};
  }

  /// Maps the first `count` > 0 elements for overwriting. Their contents are undefined until they are
  /// written.
  MappedElements<T> overwritten(std::size_t count) {
    return {*memory_, static_cast<T*>(memory_->mapToOverwrite(count * sizeof(T))), count};
  }

  void fill(const T& value) { fill(value, size_ == 0 ? 1 : size_); }

  /// Sets the first `count` elements to `value`.
  void fill(const T& value, std::size_t count) { memory_->fill(&value, sizeof(T), count * sizeof(T)); }

  /// Copies the first `count` elements of another buffer. Does not wait.
  void copy(const Buffer& from, std::size_t count) {
    if (count > 0) memory_->copy(*from.memory_, count * sizeof(T));
  }

 private:
  Buffer(DeviceContext& device, std::size_t size, bool readOnly, DeviceLane lane)
      : size_(size), memory_(std::make_shared<DeviceMemory>(device, bytesOf(size), readOnly, lane)) {}

  static std::size_t bytesOf(std::size_t size) { return (size == 0 ? 1 : size) * sizeof(T); }

  std::size_t size_ = 0;
  std::shared_ptr<DeviceMemory> memory_;
};

/// Arrays of several types for upload into one buffer of 64-byte lines. Each array begins at a line; a kernel
/// gets the buffer and the first line of each array.
template <typename Line>
class PackedArrays {
  static_assert(sizeof(Line) == 64, "arrays of any type may start in a line");

 public:
  PackedArrays() = default;

  /// Leaves `before` lines free at the start, which are written otherwise.
  explicit PackedArrays(std::size_t before) : lines_(before) {}

  /// Adds an array and returns its first line. The array must outlive the upload.
  template <typename T>
  std::uint32_t add(std::span<const T> array) {
    const auto first = static_cast<std::uint32_t>(lines_);
    parts_.push_back({lines_, std::as_bytes(array), nullptr});
    lines_ += (array.size_bytes() + sizeof(Line) - 1) / sizeof(Line);
    return first;
  }

  /// Adds an array, keeps it until the upload, and returns its first line.
  template <typename T>
  std::uint32_t add(std::vector<T>&& array) {
    const auto owner = std::make_shared<const std::vector<T>>(std::move(array));
    const std::uint32_t first = add(std::span<const T>(*owner));
    parts_.back().owner = owner;
    return first;
  }

  /// Leaves room for `size` elements that are written later, and returns their first line.
  template <typename T>
  std::uint32_t reserve(std::size_t size) {
    const auto first = static_cast<std::uint32_t>(lines_);
    lines_ += (size * sizeof(T) + sizeof(Line) - 1) / sizeof(Line);
    return first;
  }

  std::size_t lines() const { return lines_; }

  /// Writes the arrays to their lines of a buffer that is large enough.
  void upload(Buffer<Line>& buffer) const {
    for (const Part& part : parts_) buffer.writeArray(part.bytes, part.line);
  }

  Buffer<Line> upload(DeviceContext& device) const {
    Buffer<Line> buffer(device, lines_);
    upload(buffer);
    return buffer;
  }

 private:
  struct Part {
    std::size_t line;
    std::span<const std::byte> bytes;
    std::shared_ptr<const void> owner;
  };

  std::vector<Part> parts_;
  std::size_t lines_ = 0;
};

}  // namespace prelight
