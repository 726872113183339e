#include "gpu/work_queue.h"

#include <gtest/gtest.h>

#include <array>
#include <random>
#include <vector>

#include "support/devices.h"

namespace prelight {
namespace {

DeviceContext& device() { return test::sharedDevice().context(); }

/// Compares the lists of marked items, kind by kind, with lists made on the host.
void expectListed(WorkQueue& queue, const std::vector<std::uint8_t>& marks) {
  const Buffer<std::uint8_t> uploaded(device(), std::span<const std::uint8_t>(marks));
  const auto counts = queue.list(uploaded, static_cast<std::uint32_t>(marks.size()));
  for (std::uint32_t kind = 0; kind < WorkQueue::kinds; ++kind) {
    std::vector<std::uint32_t> expected;
    for (std::uint32_t i = 0; i < marks.size(); ++i)
      if ((marks[i] >> kind & 1) != 0) expected.push_back(i);
    ASSERT_EQ(counts[kind], expected.size()) << marks.size() << " marks, kind " << kind;
    std::vector<std::uint32_t> listed(expected.size());
    queue.lists().read(std::span(listed), queue.first(kind));
    EXPECT_EQ(listed, expected) << marks.size() << " marks, kind " << kind;
  }
}

TEST(WorkQueue, RandomMarks_AreListedInTheirOrder) {
  constexpr std::uint32_t most = 70000;
  WorkQueue queue(device(), most);
  std::mt19937 random(3);
  for (const std::size_t count : {1u, 2u, 255u, 256u, 257u, 4096u, 65536u, most}) {
    std::vector<std::uint8_t> marks(count);
    for (std::uint8_t& mark : marks) mark = static_cast<std::uint8_t>(random());
    expectListed(queue, marks);
  }
}

TEST(WorkQueue, AllOrNothingMarked_IsListed) {
  WorkQueue queue(device(), 1000);
  expectListed(queue, std::vector<std::uint8_t>(1000, 0));
  expectListed(queue, std::vector<std::uint8_t>(1000, 0xff));
  expectListed(queue, std::vector<std::uint8_t>(999, 4));
}

TEST(WorkQueue, NoItem_HasEmptyLists) {
  WorkQueue queue(device(), 10);
  const Buffer<std::uint8_t> marks(device(), 1);
  for (const std::uint32_t count : queue.list(marks, 0)) EXPECT_EQ(count, 0u);
}

// Moves whole items from sparse places of one part of a buffer to the beginning of another.
TEST(WorkQueue, ListedItems_MoveCloseTogetherInTheirOrder) {
  struct Item {
    std::uint32_t number, words[6];
  };
  constexpr std::uint32_t count = 3000, part = 4000;
  WorkQueue queue(device(), part);
  std::mt19937 random(5);
  std::vector<std::uint8_t> marks(count);
  std::vector<Item> items(2 * part);
  std::vector<std::uint32_t> expected;
  for (std::uint32_t i = 0; i < count; ++i) {
    marks[i] = static_cast<std::uint8_t>(random());
    items[part + i] = {i, {~i, i + 1, i + 2, i + 3, i + 4, i + 5}};
    if ((marks[i] >> 2 & 1) != 0) expected.push_back(i);
  }
  const Buffer<std::uint8_t> uploaded(device(), std::span<const std::uint8_t>(marks));
  Buffer<Item> buffer(device(), std::span<const Item>(items));
  const std::uint32_t listed = queue.list(uploaded, count)[2];
  ASSERT_EQ(listed, expected.size());
  queue.move(2, listed, QueuedItems<Item>{buffer, part, buffer, 7});
  const std::vector<Item> moved = buffer.read();
  for (std::uint32_t k = 0; k < listed; ++k) {
    EXPECT_EQ(moved[7 + k].number, expected[k]);
    EXPECT_EQ(moved[7 + k].words[0], ~expected[k]);
    EXPECT_EQ(moved[7 + k].words[5], expected[k] + 5);
  }
  EXPECT_EQ(moved[7 + listed].number, 0u) << "places beyond the list stay as they were";
}

TEST(WorkQueue, NoneListed_MovesNothing) {
  WorkQueue queue(device(), 10);
  const Buffer<std::uint8_t> marks(device(), std::span<const std::uint8_t>(std::vector<std::uint8_t>(10, 0)));
  Buffer<std::uint32_t> items(device(), std::span<const std::uint32_t>(std::vector<std::uint32_t>(20, 5)));
  queue.move(0, queue.list(marks, 10)[0], QueuedItems<std::uint32_t>{items, 0, items, 10});
  EXPECT_EQ(items.read(), std::vector<std::uint32_t>(20, 5));
}

}  // namespace
}  // namespace prelight
