#include "gpu/work_queue.h"

#include <gtest/gtest.h>

#include <array>
#include <random>
#include <vector>

#include "support/devices.h"

namespace prelight {
namespace {

DeviceContext& device() { return test::sharedDevice().context(); }

/// The lists of marks, kind by kind, against those that the host makes.
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

}  // namespace
}  // namespace prelight
