#include "gi/update/photon_groups.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

#include "receivers/sampling.h"

namespace prelight::test {
namespace {

device::PhotonSource sourceOf(std::uint32_t photons) {
  device::PhotonSource source{};
  source.kind = PRELIGHT_SOURCE_PUNCTUAL;
  source.count = photons;
  source.seed = 5;
  return source;
}

TEST(PhotonGroups, EveryPhoton_IsInOneGroup) {
  for (const std::uint32_t size : {1u, 7u, 40u}) {
    const PhotonGroups groups = makePhotonGroups(sourceOf(3080), {}, size);
    EXPECT_EQ(groups.count(), 3080 / size);
    std::vector<std::uint32_t> all = groups.photons;
    std::sort(all.begin(), all.end());
    std::vector<std::uint32_t> expected(3080);
    std::iota(expected.begin(), expected.end(), 0u);
    EXPECT_EQ(all, expected);
  }
}

TEST(PhotonGroups, NumberThatDoesNotDivide_LeavesASmallerLastGroup) {
  const PhotonGroups groups = makePhotonGroups(sourceOf(101), {}, 40);
  ASSERT_EQ(groups.count(), 3u);
  EXPECT_EQ(groups.group(2).size(), 21u);
}

TEST(PhotonGroups, MembersOfAGroup_StartAlike) {
  const PhotonGroups groups = makePhotonGroups(sourceOf(3080), {}, 40);
  double sum = 0.0, widest = 0.0;
  for (std::uint32_t g = 0; g < groups.count(); ++g) {
    glm::dvec2 lower(1.0), upper(0.0);
    for (const std::uint32_t photon : groups.group(g)) {
      const glm::dvec2 u = sampling::sobol(photon, 5);
      lower = glm::min(lower, u);
      upper = glm::max(upper, u);
    }
    const double width = std::max(upper.x - lower.x, upper.y - lower.y);
    sum += width;
    widest = std::max(widest, width);
  }
  // A square of a 77th of the area is 0.114 wide.
  EXPECT_LT(sum / groups.count(), 2.0 * 0.114);
  EXPECT_LT(widest, 4.0 * 0.114);
}

}  // namespace
}  // namespace prelight::test
