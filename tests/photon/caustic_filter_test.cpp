#include "photon/caustic_light.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "photon/photon_scenes.h"
#include "support/scenes.h"

namespace prelight {
namespace {

/// The filter for side x side photons, evenly spread over 4 m2.
CausticFilter filterFor(int side, double footprint) {
  const test::PhotonScene scene(test::ground(1, 1.0f));
  std::vector<device::Photon> photons;
  for (int j = 0; j < side; ++j)
    for (int i = 0; i < side; ++i) {
      const glm::dvec3 place(-1.0 + (2.0 * i + 1.0) / side, 0.0, -1.0 + (2.0 * j + 1.0) / side);
      photons.push_back(test::photonAt(scene, 0, place, glm::vec3(1.0f)));
    }
  return chooseCausticFilter(makePhotonMaps(photons, scene.surface), footprint);
}

// A leaf holds 4 x 2 photons, so that its box is 3 x 1 photon distances wide; 7 photons share that area.
TEST(CausticFilter, EvenPhotons_AreFoundWithinTheRadiusOfTheirDensity) {
  const CausticFilter filter = filterFor(64, 0.0);
  const double distance = 2.0 / 64.0, area = 3.0 / 7.0 * distance * distance;
  EXPECT_NEAR(filter.radius, std::sqrt(filter.density.nearest * area / std::numbers::pi), 1e-6);
  EXPECT_EQ(filter.density.minRadius, 0.0);
}

TEST(CausticFilter, CoarsePixels_BoundItsRadiusFromBelow) {
  const CausticFilter filter = filterFor(64, 1.0);
  EXPECT_DOUBLE_EQ(filter.radius, 1.5);
  EXPECT_DOUBLE_EQ(filter.density.minRadius, 1.5);
}

TEST(CausticFilter, FinePixels_LeaveItsRadiusToThePhotons) {
  EXPECT_DOUBLE_EQ(filterFor(64, 1e-3).radius, filterFor(64, 0.0).radius);
}

}  // namespace
}  // namespace prelight
