#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "base/spill_file.h"
#include "device/buffer.h"
#include "shared/cast_types.h"

namespace prelight {

/// Rows of senders, one a receiver, [row][ray]. The first of them stay in the device's memory, those that it
/// was given no room for lie in a file.
class SenderRows {
 public:
  /// At most `blockRows` rows are stored or read at once; as many in memory as `inMemory`. Each of `lanes`
  /// lanes has rows of its own on their way to the file.
  SenderRows(DeviceContext& device, std::uint32_t raysPerRow, std::uint32_t inMemory, std::uint32_t blockRows,
             std::size_t lanes = 1);

  /// Rows as a kernel finds them.
  struct Place {
    Buffer<device::Sender>& buffer;
    std::uint32_t firstRow;
  };

  /// Where a kernel in `lane` puts rows [first, first + count); once it is through, they are kept with
  /// keep().
  Place roomFor(std::uint32_t first, std::uint32_t count, DeviceLane lane = {}) {
    return inMemory(first, count) ? Place{memory_, first} : Place{blocks_[lane.number], 0};
  }
  void keep(std::uint32_t first, std::uint32_t count, DeviceLane lane = {});

  /// Whether rows stay where a kernel puts them: keep() has nothing to do.
  bool inMemory(std::uint32_t first, std::uint32_t count) const { return first + count <= inMemory_; }

  /// Where a kernel finds rows [first, first + count), until the next call.
  Place rows(std::uint32_t first, std::uint32_t count);

  /// Rows from `first` on, as many as the span holds.
  void read(std::uint32_t first, std::span<device::Sender> senders) const;
  void write(std::uint32_t first, std::span<const device::Sender> senders);

 private:
  std::size_t sendersInMemory(std::uint32_t first, std::size_t senders) const;

  std::uint32_t raysPerRow_;
  std::uint32_t inMemory_;
  Buffer<device::Sender> memory_;
  std::vector<Buffer<device::Sender>> blocks_;  ///< [lane], rows on their way to the file; back by the first
  std::vector<device::Sender> host_;
  std::optional<SpillFile> file_;  ///< made when it is needed; a row stands where it would if all were in it
};

}  // namespace prelight
