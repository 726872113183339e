#include "base/parallel.h"

#include <gtest/gtest.h>

#include <new>
#include <numeric>

namespace prelight {
namespace {

TEST(ParallelRanges, WorkThatThrows_ThrowsInTheCaller) {
  for (const std::size_t thrower : {std::size_t{0}, std::size_t{57}, std::size_t{99}})
    EXPECT_THROW(parallelRanges(
                     100, 1,
                     [&](std::size_t begin, std::size_t) {
                       if (begin == thrower) throw std::bad_alloc();
                     },
                     4),
                 std::bad_alloc);
}

TEST(ParallelRanges, EveryRange_IsWorkedOnOnce) {
  std::vector<int> counts(1000, 0);
  parallelRanges(
      1000, 7,
      [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) ++counts[i];
      },
      4);
  EXPECT_EQ(std::accumulate(counts.begin(), counts.end(), 0), 1000);
  for (const int count : counts) EXPECT_EQ(count, 1);
}

}  // namespace
}  // namespace prelight
