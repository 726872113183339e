#pragma once

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "device/buffer.h"

namespace prelight {

/// Marks on the device that kernels set and never take back, [triangle], told to other processes by the
/// triangles that are new among them.
class ToldMarks {
 public:
  /// Returns the triangles that have been marked since the last call.
  std::vector<std::uint32_t> fresh(const Buffer<std::uint8_t>& marks) {
    std::vector<std::uint8_t> now = marks.read();
    told_.resize(now.size());
    std::vector<std::uint32_t> triangles;
    for (std::uint32_t t = 0; t < now.size(); ++t)
      if (now[t] != 0 && told_[t] == 0) triangles.push_back(t);
    told_ = std::move(now);
    return triangles;
  }

 private:
  std::vector<std::uint8_t> told_;  ///< [triangle], or empty
};

/// Marks triangles, which must be below the number of marks. No kernel may set any meanwhile.
inline void mark(std::span<const std::uint32_t> triangles, Buffer<std::uint8_t>& marks) {
  if (triangles.empty()) return;
  std::vector<std::uint8_t> all = marks.read();
  for (const std::uint32_t triangle : triangles) all[triangle] = 1;
  marks.write(std::span<const std::uint8_t>(all));
}

}  // namespace prelight
