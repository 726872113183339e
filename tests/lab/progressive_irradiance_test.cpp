#include "benchmarks/lab/progressive_irradiance.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "photon/photon_scenes.h"
#include "prelight/error.h"
#include "support/devices.h"
#include "support/scenes.h"

namespace prelight {
namespace {

using device::DensityQuery;
using device::Photon;
using test::PhotonScene;

constexpr double height = 0.4;  // Height in metres of a point light of 4 pi W above the middle of a square.

double irradianceAt(const glm::dvec3& p) {
  const double squared = p.x * p.x + p.z * p.z + height * height;
  return height / (squared * std::sqrt(squared));
}

/// Photons of the light that land on the square, out of `count`.
std::vector<Photon> photonsOfLight(const PhotonScene& scene, int count, std::mt19937& random) {
  std::vector<Photon> photons;
  for (int i = 0; i < count; ++i) {
    const glm::dvec3 way(test::randomDirection(random));
    const glm::dvec3 at = way * (-height / way.y);
    if (way.y >= 0.0 || std::abs(at.x) > 1.0 || std::abs(at.z) > 1.0) continue;
    photons.push_back(test::photonAt(scene, 0, {at.x, 0.0, at.z},
                                     glm::vec3(static_cast<float>(4.0 * std::numbers::pi / count))));
  }
  return photons;
}

TEST(ProgressiveIrradiance, ErrorSquared_FallsAsWorkToTheTwoThirds) {
  const PhotonScene scene(test::ground(1, 1.0f));
  std::mt19937 random(1);
  std::vector<DensityQuery> queries;
  std::uniform_real_distribution<double> place(-0.5, 0.5);
  for (int i = 0; i < 400; ++i)
    queries.push_back(test::queryAt(scene, 0, {place(random), 0.0, place(random)}, 0.25));
  DensityEstimator estimator(scene.surface, {}, test::sharedDevice());
  ProgressiveIrradiance progressive(queries);
  std::vector<std::pair<double, double>> logs;
  for (int pass = 1; pass <= 1024; ++pass) {
    progressive.addPass(makePhotonMaps(photonsOfLight(scene, 2000, random), scene.surface), estimator);
    if ((pass & (pass - 1)) != 0 || pass < 16) continue;
    const auto found = progressive.irradiance();
    double squares = 0.0;
    for (std::size_t i = 0; i < queries.size(); ++i) {
      const float* p = queries[i].position;
      squares += std::pow(static_cast<double>(found[i].y) - irradianceAt({p[0], p[1], p[2]}), 2.0);
    }
    logs.emplace_back(std::log(pass), std::log(squares / static_cast<double>(queries.size())));
  }
  double x = 0.0, y = 0.0, xx = 0.0, xy = 0.0;
  for (const auto& [a, b] : logs) {
    x += a, y += b, xx += a * a, xy += a * b;
  }
  const double n = static_cast<double>(logs.size()), slope = (n * xy - x * y) / (n * xx - x * x);
  EXPECT_NEAR(slope, -2.0 / 3.0, 0.07);
}

TEST(ProgressiveIrradiance, Radii_ShrinkByTheSchedule) {
  const PhotonScene scene(test::ground(1, 1.0f));
  DensityEstimator estimator(scene.surface, {}, test::sharedDevice());
  const PhotonMaps none = makePhotonMaps({}, scene.surface);
  ProgressiveIrradiance progressive({test::queryAt(scene, 0, {0, 0, 0}, 0.5)}, 0.5);
  EXPECT_EQ(progressive.radiusShare(), 1.0);
  EXPECT_EQ(progressive.irradiance()[0], glm::vec3(0.0f));
  for (int pass = 0; pass < 3; ++pass) progressive.addPass(none, estimator);
  EXPECT_NEAR(progressive.radiusShare(), std::sqrt(1.5 / 2.0 * (2.5 / 3.0) * (3.5 / 4.0)), 1e-12);
  EXPECT_THROW(ProgressiveIrradiance({}, 1.1), UsageError);
}

}  // namespace
}  // namespace prelight
