#include "base/threads.h"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <stdexcept>
#include <vector>

namespace prelight {
namespace {

TEST(BackgroundWork, Pieces_AreDoneInTheirOrder) {
  std::vector<int> done;
  BackgroundWork work(2);
  for (int i = 0; i < 200; ++i) work.add([&done, i] { done.push_back(i); });
  work.finish();
  ASSERT_EQ(done.size(), 200u);
  for (int i = 0; i < 200; ++i) EXPECT_EQ(done[static_cast<std::size_t>(i)], i);
}

// A buffer that a piece of work uses is free again when its turn comes round.
TEST(BackgroundWork, PlacesInTurns_AreNotInUseWhenTheyComeRound) {
  constexpr std::size_t waiting = 1;
  std::vector<std::atomic<bool>> inUse(BackgroundWork::placesFor(waiting));
  BackgroundWork work(waiting);
  for (std::size_t i = 0; i < 60; ++i) {
    std::atomic<bool>& place = inUse[i % inUse.size()];
    EXPECT_FALSE(place.exchange(true)) << i;
    work.add([&place] {
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
      place = false;
    });
  }
  work.finish();
}

TEST(BackgroundWork, PieceThatThrows_ThrowsAtTheEnd) {
  BackgroundWork work(4);
  work.add([] { throw std::runtime_error("broken"); });
  EXPECT_THROW(work.finish(), std::runtime_error);
  EXPECT_THROW(work.finish(), std::runtime_error) << "what is lost stays lost";
}

TEST(BackgroundWork, AfterAFailure_NothingFurtherIsTaken) {
  BackgroundWork work(1);
  work.add([] { throw std::runtime_error("broken"); });
  EXPECT_THROW(
      {
        for (int i = 0; i < 10; ++i) work.add([] {});
        work.finish();
      },
      std::runtime_error);
}

TEST(BackgroundWork, NothingToDo_FinishesAtOnce) {
  BackgroundWork work(1);
  EXPECT_NO_THROW(work.finish());
}

}  // namespace
}  // namespace prelight
