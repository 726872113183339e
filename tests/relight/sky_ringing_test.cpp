#include "relight/sky_ringing.h"

#include <gtest/gtest.h>

namespace prelight {
namespace {

TEST(WithoutRinging, SkyOfANegativeSeries_IsAShareOfTheSmoothedOne) {
  EXPECT_EQ(withoutRinging(0.5, 0.4), 0.5);
  EXPECT_GT(withoutRinging(-0.1, 0.4), 0.05);
  EXPECT_EQ(withoutRinging(0.0, 0.0), 0.0);
}

}  // namespace
}  // namespace prelight
