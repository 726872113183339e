#include "benchmarks/run/timing.h"

#include <gmock/gmock.h>

#include <atomic>
#include <thread>

#include "benchmarks/peers/embree/worker_pool.h"

namespace prelight::benchmarks {
namespace {

using ::testing::Each;
using ::testing::ElementsAre;

TEST(WorkerPool, Run_OverAndOver_CoversEveryItemOnce) {
  WorkerPool pool(3);
  EXPECT_EQ(pool.threads(), 3u);
  for (const std::size_t count : {1u, 999u, 1000u, 1001u}) {
    std::vector<std::atomic<int>> visits(count);
    pool.run(count, 100, [&](std::size_t begin, std::size_t end) {
      EXPECT_LE(end - begin, 100u);
      for (std::size_t i = begin; i < end; ++i) ++visits[i];
    });
    for (const auto& visit : visits) EXPECT_EQ(visit, 1);
  }
}

TEST(TakeTurns, Rounds_GiveEveryContenderTheSamePart) {
  std::vector<std::size_t> own, other;
  std::vector<Contender> contenders = {{"own", [&](std::size_t part) { own.push_back(part); }},
                                       {"other", [&](std::size_t part) { other.push_back(part); }, 2}};
  takeTurns(contenders, 3, 5, Progress());
  EXPECT_THAT(own, ElementsAre(0, 0, 1, 2, 0, 1));  // the first warms up
  EXPECT_THAT(other, ElementsAre(0, 0, 2, 1));
  EXPECT_THAT(contenders[0].seconds, Each(testing::Ge(0.0)));
  EXPECT_THAT(contenders[1].seconds,
              ElementsAre(testing::Ge(0.0), -1.0, testing::Ge(0.0), -1.0, testing::Ge(0.0)));
}

TEST(TakeTurns, Summaries_OfKnownSeconds_AreThoseByHand) {
  const std::vector<double> own = {1, 10, 2, 10, 3, 40}, other = {2, 5, -1, 20, 9, -1};
  EXPECT_DOUBLE_EQ(medianRatio(own, other), 2.0);  // of 2, 0.5, 2, 3
  EXPECT_DOUBLE_EQ(medianSeconds(own, 2), 2.0 + 10.0);
  EXPECT_DOUBLE_EQ(leastSeconds(other, 2), 2.0 + 5.0);
}

}  // namespace
}  // namespace prelight::benchmarks
