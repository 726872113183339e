#include "base/threads.h"

#include <gtest/gtest.h>

#include <atomic>
#include <numeric>

namespace prelight {
namespace {

TEST(ThreadTeam, Ranges_CoverEverythingOnceWhateverTheSize) {
  for (const std::size_t threads : {1, 2, 3, 7}) {
    std::vector<int> counts(1000, 0);
    runTeam(threads, [&](const TeamMember& member) {
      member.ranges(counts.size(), 64, [&](std::size_t begin, std::size_t end) {
        EXPECT_EQ(begin % 64, 0u);
        for (std::size_t i = begin; i < end; ++i) ++counts[i];
      });
    });
    for (const int count : counts) EXPECT_EQ(count, 1);
  }
}

// After a wait, each thread sees what the others did before it.
TEST(ThreadTeam, Wait_LetsNobodyPassBeforeAllHaveCome) {
  constexpr std::size_t threads = 4;
  std::atomic<int> arrived = 0;
  std::atomic<bool> early = false;
  runTeam(threads, [&](const TeamMember& member) {
    for (int step = 1; step <= 100; ++step) {
      ++arrived;
      member.wait();
      if (arrived < step * static_cast<int>(threads)) early = true;
      member.wait();
    }
  });
  EXPECT_FALSE(early);
  EXPECT_EQ(arrived, 400);
}

}  // namespace
}  // namespace prelight
