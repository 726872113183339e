#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>

#include "device/buffer.h"
#include "device/kernel.h"
#include "shared/queue_types.h"

namespace prelight {

/// The items of a step that a kernel has marked, listed on the device in the order of their numbers: for all
/// that follows paths from step to step. A mark is a byte whose bits are kinds.
class WorkQueue {
 public:
  static constexpr std::size_t kinds = PRELIGHT_QUEUE_KINDS;

  /// Serves steps of at most `most` items.
  WorkQueue(DeviceContext& device, std::uint32_t most);

  /// Lists the items of every kind; returns how many each has. `marks`: [count].
  std::array<std::uint32_t, kinds> list(const Buffer<std::uint8_t>& marks, std::uint32_t count);

  /// [kind][most], ascending; of the last list().
  const Buffer<std::uint32_t>& lists() const { return lists_; }

  /// Where a kind's list begins in lists().
  std::uint32_t first(std::uint32_t kind) const { return kind * most_; }

 private:
  std::uint32_t most_;
  Buffer<glm::uvec4> counts_;  ///< [run + 1]
  Buffer<std::uint32_t> lists_;
  Kernel<std::uint32_t, Buffer<std::uint8_t>, Buffer<glm::uvec4>> count_;
  Kernel<std::uint32_t, Buffer<glm::uvec4>> start_;
  Kernel<std::uint32_t, std::uint32_t, Buffer<std::uint8_t>, Buffer<glm::uvec4>, Buffer<std::uint32_t>> list_;
};

/// Moves items of a type that a work queue has listed close together.
template <typename T>
class ListedItems {
 public:
  ListedItems() = default;
  explicit ListedItems(DeviceContext& device) {
    const auto words = static_cast<int>(sizeof(T) / sizeof(std::uint32_t));
    move_ = {device, "core/queue_kernels.cl", BuildOptions().define("PRELIGHT_ITEM_WORDS", words),
             "moveListed"};
  }

  /// The first `count` items of a kind, from the places after `from` that they have by their numbers, to
  /// those after `to`. The two may be parts of one buffer that do not overlap.
  void move(const WorkQueue& queue, std::uint32_t kind, std::uint32_t count, const Buffer<T>& items,
            std::uint32_t from, Buffer<T>& moved, std::uint32_t to) {
    if (count > 0) move_.launch(count, count, queue.first(kind), queue.lists(), from, items, to, moved);
  }

 private:
  Kernel<std::uint32_t, std::uint32_t, Buffer<std::uint32_t>, std::uint32_t, Buffer<T>, std::uint32_t,
         Buffer<T>>
      move_;
};

}  // namespace prelight
