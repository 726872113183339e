#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "device/buffer.h"

namespace prelight {

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
