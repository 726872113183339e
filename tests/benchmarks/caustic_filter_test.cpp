#include "photon/caustic_light.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "benchmarks/suites/indirect/caustics.h"
#include "support/devices.h"

namespace prelight::benchmarks {
namespace {

constexpr int side = 128;  // pixels of a picture of the floor

/// Irradiance at the pixels of the floor of the mirrored cylinder.
struct Floor {
  explicit Floor(std::size_t photonCount)
      : scene(makeSquares(1)), surface(makeDensitySurface(scene, wholeRegion(scene))) {
    std::mt19937 random(1);
    const std::vector<device::Photon> photons = MirroredCylinder::photons(photonCount, random);
    const PhotonMaps maps = makePhotonMaps(photons, surface);
    filter = chooseCausticFilter(maps, 1.0 / side);
    DensityEstimator estimator(surface, filter.density, test::sharedDevice());
    estimator.setPhotons(maps);
    std::vector<device::DensityQuery> queries;
    for (int i = 0; i < side * side; ++i) {
      const float x = (static_cast<float>(i % side) + 0.5f) / side,
                  z = (static_cast<float>(i / side) + 0.5f) / side;
      queries.push_back(
          {{x, 0, z}, z > x ? 0u : 1u, {0, 1, 0}, static_cast<float>(filter.radius), PRELIGHT_WHOLE_REGION});
    }
    irradiance = estimator.estimate(queries);
  }

  CompiledScene scene;
  DensitySurface surface;
  CausticFilter filter;
  std::vector<glm::vec3> irradiance;
};

double truth(int pixel) {
  constexpr int parts = 6;
  double sum = 0.0;
  for (int k = 0; k < parts * parts; ++k)
    sum += MirroredCylinder::irradiance((pixel % side + (k % parts + 0.5) / parts) / side,
                                        (pixel / side + (k / parts + 0.5) / parts) / side);
  return sum / (parts * parts);
}

TEST(MirroredCylinder, Irradiance_IsWhereItsPhotonsLand) {
  std::mt19937 random(2);
  constexpr int cells = 8, count = 400000, samples = 1500;
  std::vector<double> power(cells * cells, 0.0);
  for (const device::Photon& photon : MirroredCylinder::photons(count, random)) {
    const int x = std::min(static_cast<int>(photon.position[0] * cells), cells - 1);
    const int z = std::min(static_cast<int>(photon.position[2] * cells), cells - 1);
    power[static_cast<std::size_t>(z * cells + x)] += static_cast<double>(photon.power[0]);
  }
  std::uniform_real_distribution<double> unit;
  for (int cell = 0; cell < cells * cells; ++cell) {
    double sum = 0.0, squares = 0.0;
    for (int k = 0; k < samples; ++k) {
      const double x = (cell % cells + unit(random)) / cells, z = (cell / cells + unit(random)) / cells;
      const double share = MirroredCylinder::irradiance(x, z) / (cells * cells);
      sum += share;
      squares += share * share;
    }
    const double expected = sum / samples,
                 error = std::sqrt((squares / samples - expected * expected) / samples);
    const double found = power[static_cast<std::size_t>(cell)];
    EXPECT_NEAR(found, expected, 4.0 * (error + std::sqrt(expected / count)) + 1e-5) << cell;
  }
}

TEST(CausticFilter, Nephroid_KeepsItsPowerAndErrsLittle) {
  const Floor floor(200000);
  double power = 0.0, squares = 0.0;
  std::vector<double> truths, errors;
  for (int i = 0; i < side * side; ++i) {
    truths.push_back(truth(i));
    squares += std::min(truths.back(), 20.0) * std::min(truths.back(), 20.0);
  }
  for (int i = 0; i < side * side; ++i) {
    const double found = static_cast<double>(floor.irradiance[static_cast<std::size_t>(i)].x);
    power += found / (side * side);
    if (truths[i] > 0.0)
      errors.push_back(std::pow(found - truths[i], 2.0) /
                       (truths[i] * truths[i] + 0.01 * squares / (side * side)));
  }
  EXPECT_NEAR(power, 1.0, 0.02);
  std::sort(errors.begin(), errors.end());
  errors.resize(errors.size() * 99 / 100);
  double sum = 0.0;
  for (const double error : errors) sum += error;
  EXPECT_LT(sum / static_cast<double>(errors.size()), 0.025);
}

TEST(CausticFilter, MorePhotons_AreFilteredOverLess) {
  const Floor few(5000), many(80000);
  EXPECT_GT(many.filter.density.nearest, 2 * few.filter.density.nearest);
  EXPECT_LT(many.filter.radius, 0.7 * few.filter.radius);
  EXPECT_DOUBLE_EQ(many.filter.density.minRadius, 1.5 / side);
}

TEST(CausticFilter, FewOrCoincidentPhotons_HaveAFilter) {
  const CompiledScene scene = makeSquares(1);
  const DensitySurface surface = makeDensitySurface(scene, wholeRegion(scene));
  for (const std::size_t count : {0u, 1u, 3u, 500u}) {
    const std::vector<device::Photon> photons(count, makePhoton({0.5, 0.0, 0.25}, 1, 1.0));
    const CausticFilter filter = chooseCausticFilter(makePhotonMaps(photons, surface));
    EXPECT_GT(filter.radius, 0.0) << count;
    EXPECT_GE(filter.density.nearest, 2) << count;
  }
}

}  // namespace
}  // namespace prelight::benchmarks
