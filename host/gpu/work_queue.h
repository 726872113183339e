#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <memory>

#include "device/buffer.h"
#include "device/kernel.h"
#include "shared/queue_types.h"

namespace prelight {

/// Items that move when they are listed, from the places after `from` that they have by their numbers to
/// those after `to`. The two may be parts of one buffer that do not overlap.
template <typename T>
struct QueuedItems {
  const Buffer<T>& items;
  std::uint32_t from = 0;
  Buffer<T>& moved;
  std::uint32_t to = 0;
};

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

  /// Moves the first `count` items of a kind close together.
  template <typename T>
  void move(std::uint32_t kind, std::uint32_t count, const QueuedItems<T>& items) {
    launchMove(kind, count, items, items, 0);
  }

  /// The same of two arrays.
  template <typename T, typename U>
  void move(std::uint32_t kind, std::uint32_t count, const QueuedItems<T>& items,
            const QueuedItems<U>& more) {
    launchMove(kind, count, items, more, wordsOf<U>());
  }

 private:
  template <typename T>
  static constexpr std::uint32_t wordsOf() {
    static_assert(sizeof(T) % sizeof(std::uint32_t) == 0);
    return sizeof(T) / sizeof(std::uint32_t);
  }

  template <typename T, typename U>
  void launchMove(std::uint32_t kind, std::uint32_t count, const QueuedItems<T>& items,
                  const QueuedItems<U>& more, std::uint32_t wordsOfMore) {
    if (count == 0) return;
    const device::QueueMove step{
        count, first(kind), {wordsOf<T>(), wordsOfMore}, {items.from, more.from}, {items.to, more.to}};
    move_->set(0, step);
    move_->set(1, lists_);
    move_->set(2, items.items);
    move_->set(3, items.moved);
    move_->set(4, more.items);
    move_->set(5, more.moved);
    move_->launch(count);
  }

  std::uint32_t most_;
  Buffer<glm::uvec4> counts_;  ///< [run + 1]
  Buffer<std::uint32_t> lists_;
  Kernel<std::uint32_t, Buffer<std::uint8_t>, Buffer<glm::uvec4>> count_;
  Kernel<std::uint32_t, Buffer<glm::uvec4>> start_;
  Kernel<std::uint32_t, std::uint32_t, Buffer<std::uint8_t>, Buffer<glm::uvec4>, Buffer<std::uint32_t>> list_;
  Kernel<std::uint32_t, std::uint32_t, Buffer<std::uint8_t>, Buffer<glm::uvec4>, Buffer<std::uint32_t>> few_;
  std::unique_ptr<BuiltKernel> move_;  ///< of items of any type, word by word
};

}  // namespace prelight
