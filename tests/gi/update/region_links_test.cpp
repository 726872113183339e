#include "gi/update/live_gather.h"

#include <gtest/gtest.h>

#include <vector>

namespace prelight {
namespace {

constexpr std::uint32_t sky = 0xffffffffu;

/// Three regions of one triangle each, of 1, 4 and 2 m2.
RegionLinks linksOf(std::vector<std::uint8_t> relays = {0, 0, 0}) {
  return {SurfaceRegions{{0, 1, 2}, {1.0, 4.0, 2.0}}, std::move(relays)};
}

void addRays(RegionLinks& links, std::uint32_t region, std::vector<std::uint32_t> triangles) {
  links.add(region, triangles);
}

/// Expected changes [region] after a change of one region.
std::vector<double> expectedFor(const RegionLinks& links, std::uint32_t region, double irradiance,
                                double least = 0.0) {
  std::vector<double> expected(3, 0.0);
  const std::vector<RegionChange> changes{{region, irradiance}};
  links.spread(changes, least, expected);
  return expected;
}

TEST(RegionLinks, RegionThatLooks_GetsTheShareOfItsView) {
  RegionLinks links = linksOf();
  addRays(links, 1, {0, sky, sky, sky});
  EXPECT_EQ(expectedFor(links, 0, 8.0), (std::vector<double>{0.0, 2.0, 0.0}));
}

// Reciprocity: F_ba = F_ab A_a / A_b.
TEST(RegionLinks, RegionThatIsLookedAt_GetsTheShareOfTheOther) {
  RegionLinks links = linksOf();
  addRays(links, 0, {1, 1, 1, sky});
  EXPECT_EQ(expectedFor(links, 0, 8.0), (std::vector<double>{0.0, 1.5, 0.0}));
  // The share is at most the whole view, however few rays it is estimated from.
  EXPECT_EQ(expectedFor(links, 1, 8.0), (std::vector<double>{6.0, 0.0, 0.0}));
  RegionLinks small = linksOf();
  addRays(small, 1, {0, 0, sky, sky});
  EXPECT_EQ(expectedFor(small, 1, 8.0), (std::vector<double>{8.0, 0.0, 0.0}));
}

TEST(RegionLinks, BothLook_TheLargerShareCounts) {
  RegionLinks links = linksOf();
  addRays(links, 0, {1, sky});
  addRays(links, 1, {0, 0, sky, sky});
  EXPECT_EQ(expectedFor(links, 0, 8.0), (std::vector<double>{0.0, 4.0, 0.0}));
}

TEST(RegionLinks, Relay_PassesOnWhatIsEnoughOnce) {
  RegionLinks links = linksOf({0, 1, 0});
  addRays(links, 1, {0, sky});
  addRays(links, 2, {1, 1, 1, sky});
  // Region 0 is half of the view of region 1. By reciprocity region 1 fills the whole view of region 0, so
  // that the whole change comes back there.
  EXPECT_EQ(expectedFor(links, 0, 8.0, 4.0), (std::vector<double>{4.0, 4.0, 3.0}));
  EXPECT_EQ(expectedFor(links, 0, 8.0, 4.5), (std::vector<double>{0.0, 4.0, 0.0}));
}

// After twice the rays of the first pass, older rays count half.
TEST(RegionLinks, LaterRays_DisplaceEarlierOnes) {
  RegionLinks links = linksOf();
  addRays(links, 1, {0, 0});
  links.endPass();
  for (int i = 0; i < 3; ++i) addRays(links, 1, {sky, sky});
  EXPECT_EQ(expectedFor(links, 0, 5.0), (std::vector<double>{0.0, 5.0 * 1.0 / 5.0, 0.0}));
}

TEST(RegionLinks, ChangeOfNothing_SpreadsNothing) {
  RegionLinks links = linksOf();
  addRays(links, 1, {0});
  EXPECT_EQ(expectedFor(links, 0, 0.0), (std::vector<double>{0.0, 0.0, 0.0}));
}

}  // namespace
}  // namespace prelight
