#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "device/buffer.h"

namespace prelight {

/// Arrays of several types to be uploaded into one buffer of lines of 64 bytes, each from a line on: a kernel
/// gets the buffer and the first line of each array.
template <typename Line>
class PackedArrays {
  static_assert(sizeof(Line) == 64, "arrays of any type may start in a line");

 public:
  PackedArrays() = default;

  /// Behind so many lines, which are written otherwise.
  explicit PackedArrays(std::size_t before) : lines_(before) {}

  /// Returns the array's first line. The array must outlive the upload.
  template <typename T>
  std::uint32_t add(std::span<const T> array) {
    const auto first = static_cast<std::uint32_t>(lines_);
    parts_.push_back({lines_, std::as_bytes(array), nullptr});
    lines_ += (array.size_bytes() + sizeof(Line) - 1) / sizeof(Line);
    return first;
  }

  /// Keeps it until the upload.
  template <typename T>
  std::uint32_t add(std::vector<T>&& array) {
    const auto owner = std::make_shared<const std::vector<T>>(std::move(array));
    const std::uint32_t first = add(std::span<const T>(*owner));
    parts_.back().owner = owner;
    return first;
  }

  /// Leaves room for `size` elements, to be written later.
  template <typename T>
  std::uint32_t reserve(std::size_t size) {
    const auto first = static_cast<std::uint32_t>(lines_);
    lines_ += (size * sizeof(T) + sizeof(Line) - 1) / sizeof(Line);
    return first;
  }

  std::size_t lines() const { return lines_; }

  /// Writes the arrays to their places in a buffer that they fit into.
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
