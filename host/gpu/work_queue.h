#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <memory>

#include "device/buffer.h"
#include "device/kernel.h"
#include "shared/queue_types.h"

namespace prelight {

/// An array whose listed items are moved: from `items`, beginning at `from`, at their own indices, to
/// consecutive places in `moved`, beginning at `to`. The two may be disjoint parts of one buffer.
template <typename T>
struct QueuedItems {
  const Buffer<T>& items;
  std::uint32_t from = 0;
  Buffer<T>& moved;
  std::uint32_t to = 0;
};

/// Lists the items of a step that a kernel has marked, on the device and in the order of their indices, for
/// algorithms that follow paths step by step. A mark is a byte with one bit per kind.
class WorkQueue {
 public:
  static constexpr std::size_t kinds = PRELIGHT_QUEUE_KINDS;

  /// Supports steps of at most `most` items.
  WorkQueue(DeviceContext& device, std::uint32_t most);

  /// Lists the items of every kind. Returns the number of items per kind. `marks` is [count].
  std::array<std::uint32_t, kinds> list(const Buffer<std::uint8_t>& marks, std::uint32_t count);

  /// Returns the lists of the last list(), [kind][most], ascending.
  const Buffer<std::uint32_t>& lists() const { return lists_; }

  /// Returns the beginning of a kind's list in lists().
  std::uint32_t first(std::uint32_t kind) const { return kind * most_; }

  /// Moves the first `count` items of a kind to consecutive places.
  template <typename T>
  void move(std::uint32_t kind, std::uint32_t count, const QueuedItems<T>& items) {
    launchMove(kind, count, items, items, 0);
  }

  /// Moves the items of two arrays.
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
  std::unique_ptr<BuiltKernel> move_;  ///< copies items of any type word by word
};

}  // namespace prelight
