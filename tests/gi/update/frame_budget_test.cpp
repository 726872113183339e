#include "gi/update/frame_budget.h"

#include <gtest/gtest.h>

namespace prelight::test {
namespace {

TEST(FrameBudget, NoSeconds_LimitNothing) {
  FrameBudget budget(0.0, {});
  budget.begin();
  budget.spend(FrameWork::Rays, 1u << 30);
  EXPECT_EQ(budget.affordable(FrameWork::Photons), FrameBudget::unlimited);
}

TEST(FrameBudget, WithoutAClock_WorkOfOneKindLeavesLessForOthers) {
  FrameBudget budget(0.03, {});
  budget.begin();
  const std::uint32_t photons = budget.affordable(FrameWork::Photons);
  const std::uint32_t rays = budget.affordable(FrameWork::Rays);
  budget.spend(FrameWork::Photons, photons / 2);
  EXPECT_NEAR(budget.affordable(FrameWork::Rays), rays / 2.0, rays * 0.001);
  budget.spend(FrameWork::Photons, photons);
  EXPECT_EQ(budget.affordable(FrameWork::Rays), FrameBudget::leastItems);
  budget.begin();
  EXPECT_EQ(budget.affordable(FrameWork::Rays), rays);
}

TEST(FrameBudget, WorkThatTakesTwiceAsLong_IsHalvedOverTheFrames) {
  constexpr double seconds = 0.03, perRay = 1e-6;
  double now = 5.0;
  FrameBudget budget(seconds, [&] { return now; });
  for (int frame = 0; frame < 60; ++frame) {
    budget.begin();
    const std::uint32_t rays = budget.affordable(FrameWork::Rays);
    now += perRay * rays;
    budget.spend(FrameWork::Rays, rays);
    now += 100.0;  // time between frames is nobody's
  }
  budget.begin();
  EXPECT_NEAR(budget.affordable(FrameWork::Rays), seconds / perRay, 0.02 * seconds / perRay);
}

TEST(FrameBudget, OneVerySlowFrame_DoesNotStarveTheNext) {
  double now = 0.0;
  FrameBudget budget(0.03, [&] { return now; });
  budget.begin();
  const std::uint32_t rays = budget.affordable(FrameWork::Rays);
  now += 10.0;
  budget.spend(FrameWork::Rays, rays);
  budget.begin();
  EXPECT_GT(budget.affordable(FrameWork::Rays), rays / 2);
}

}  // namespace
}  // namespace prelight::test
