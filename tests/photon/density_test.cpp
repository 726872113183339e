#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstring>
#include <numbers>

#include "base/directions.h"
#include "basis/sh_evaluate.h"
#include "photon/photon_scenes.h"
#include "prelight/error.h"
#include "support/devices.h"
#include "support/scenes.h"

namespace prelight {
namespace {

using device::DensityQuery;
using device::Photon;
using test::photonAt;
using test::PhotonScene;
using test::queryAt;

using std::numbers::pi;
constexpr DensityKernel kernels[] = {DensityKernel::Constant, DensityKernel::Cone,
                                     DensityKernel::Epanechnikov};

/// Integral of a kernel over a disc of radius 1.
double discIntegral(DensityKernel kernel) {
  return kernel == DensityKernel::Constant ? pi : kernel == DensityKernel::Cone ? pi / 3.0 : pi / 2.0;
}

/// A wavy sheet over [-1, 1]^2 whose slopes differ strongly.
CompiledScene wavySheet(int cells, double height) {
  CompiledScene sheet = test::ground(cells, 1.0f);
  for (glm::vec3& p : sheet.positions)
    p.y = static_cast<float>(height * std::sin(4.0 * static_cast<double>(p.x)) *
                             std::cos(3.0 * static_cast<double>(p.z)));
  return sheet;
}

void expectBruteForce(const PhotonScene& scene, double radius, const DensityOptions& options,
                      double tolerance) {
  std::mt19937 random(11);
  const auto photons = test::uniformPhotons(scene, 3000, {1.0f, 0.5f, 2.0f}, random);
  std::vector<DensityQuery> queries;
  for (int i = 0; i < 40; ++i) queries.push_back(test::randomQuery(scene, radius, random));
  const auto found = test::estimate(scene, photons, queries, options);
  for (std::size_t i = 0; i < queries.size(); ++i) {
    const glm::dvec3 expected = test::bruteIrradiance(scene, photons, queries[i], options);
    EXPECT_NEAR(found[i].x, expected.x, tolerance * expected.x) << i;
    EXPECT_NEAR(found[i].y, 0.5 * expected.x, tolerance * expected.x) << i;
    EXPECT_NEAR(found[i].z, 2.0 * expected.x, 2.0 * tolerance * expected.x) << i;
  }
}

TEST(Density, AnyKernelWithinARadius_IsTheBruteForceEstimate) {
  const std::pair<PhotonScene, double> cases[] = {
      {PhotonScene(test::ground(1, 1.0f)), 0.3},
      {PhotonScene(test::ground(24, 1.0f)), 0.4},
      {PhotonScene(test::sphere(24, 1.0f, {3, 0, 0})), 0.4},
      {PhotonScene(wavySheet(16, 0.3)), 0.3},
      {PhotonScene(test::box(2, glm::vec3(-1.0f), glm::vec3(1.0f, 2.0f, 1.0f), true)), 0.5}};
  for (const auto& [scene, radius] : cases)
    for (const DensityKernel kernel : kernels) {
      SCOPED_TRACE(testing::Message()
                   << scene.scene.triangleCount() << " triangles, kernel " << static_cast<int>(kernel));
      expectBruteForce(scene, radius, {.kernel = kernel}, 4e-3);
    }
}

TEST(Density, NearestPhotons_IsTheBruteForceEstimate) {
  const std::pair<PhotonScene, double> cases[] = {{PhotonScene(test::ground(3, 1.0f)), 1.0},
                                                  {PhotonScene(test::sphere(24, 1.0f, {3, 0, 0})), 0.5},
                                                  {PhotonScene(wavySheet(16, 0.3)), 0.4}};
  for (const auto& [scene, radius] : cases)
    for (const int nearest : {2, 7, 50, 400, 4000}) {
      SCOPED_TRACE(testing::Message() << scene.scene.triangleCount() << " triangles, k " << nearest);
      expectBruteForce(scene, radius, {.nearest = nearest, .minRadius = 0.05}, 4e-3);
    }
}

/// Mean, and its standard error, of estimates at one place from independent sets of photons.
struct Mean {
  double mean = 0.0;
  double error = 0.0;
};

Mean meanOf(const std::vector<double>& values) {
  double sum = 0.0, squares = 0.0;
  for (const double value : values) sum += value;
  const double count = static_cast<double>(values.size()), mean = sum / count;
  for (const double value : values) squares += (value - mean) * (value - mean);
  return {mean, std::sqrt(squares / (count * (count - 1.0)))};
}

/// Mean estimates [query] of a constant irradiance of 1 W/m2 from `sets` independent sets of photons.
std::vector<Mean> constantIrradiance(const PhotonScene& scene, std::span<const DensityQuery> queries,
                                     const DensityOptions& options, std::size_t photonCount, int sets) {
  std::mt19937 random(3);
  DensityEstimator estimator(scene.surface, options, test::sharedDevice());
  std::vector<std::vector<double>> values(queries.size());
  std::poisson_distribution<std::size_t> poisson(static_cast<double>(photonCount));
  const float power = static_cast<float>(scene.areaSums.back() / static_cast<double>(photonCount));
  for (int set = 0; set < sets; ++set) {
    const auto photons = test::uniformPhotons(scene, poisson(random), glm::vec3(power), random);
    estimator.setPhotons(makePhotonMaps(photons, scene.surface));
    const auto found = estimator.estimate(queries);
    for (std::size_t i = 0; i < queries.size(); ++i) values[i].push_back(static_cast<double>(found[i].x));
  }
  std::vector<Mean> means;
  for (const auto& of : values) means.push_back(meanOf(of));
  return means;
}

void expectOne(const std::vector<Mean>& means) {
  for (std::size_t i = 0; i < means.size(); ++i) {
    EXPECT_NEAR(means[i].mean, 1.0, 3.5 * means[i].error) << "query " << i;
    EXPECT_LT(means[i].error, 0.012) << "query " << i;
  }
}

TEST(Density, ConstantIrradiance_HasNoBiasUpToEdgesAndCorners) {
  const PhotonScene scene(test::ground(2, 1.0f));
  std::vector<DensityQuery> queries;
  for (const glm::dvec3 at :
       {glm::dvec3(-0.3, 0, -0.4), {-0.999, 0, -0.5}, {-0.95, 0, -0.95}, {-1, 0, -1}, {-0.8, 0, -0.9}})
    for (std::uint32_t t = 0; t < scene.scene.triangleCount(); ++t) {
      const glm::dvec3 a = scene.pointOn(t, 0, 0), b = scene.pointOn(t, 1, 0), c = scene.pointOn(t, 0, 1);
      const glm::dvec3 n = scene.normalOf(t);
      const bool inside = glm::dot(n, glm::cross(b - a, at - a)) >= 0 &&
                          glm::dot(n, glm::cross(c - b, at - b)) >= 0 &&
                          glm::dot(n, glm::cross(a - c, at - c)) >= 0;
      if (!inside) continue;
      queries.push_back(queryAt(scene, t, at, 0.25));
      break;
    }
  ASSERT_EQ(queries.size(), 5u);
  for (const DensityKernel kernel : kernels) {
    SCOPED_TRACE(testing::Message() << "kernel " << static_cast<int>(kernel));
    expectOne(constantIrradiance(scene, queries, {.kernel = kernel}, 6000, 300));
    expectOne(constantIrradiance(scene, queries, {.kernel = kernel, .nearest = 50}, 6000, 1000));
  }
}

TEST(Density, ConstantIrradianceOnABall_HasNoBias) {
  const PhotonScene scene(test::sphere(24, 1.0f, {0, 2, 0}));
  std::mt19937 random(8);
  std::vector<DensityQuery> queries;
  for (int i = 0; i < 8; ++i) queries.push_back(test::randomQuery(scene, 0.4, random));
  expectOne(constantIrradiance(scene, queries, {}, 10000, 300));
  expectOne(constantIrradiance(scene, queries, {.nearest = 100}, 10000, 300));
}

TEST(Density, LightOnOneWall_DoesNotReachItsNeighbours) {
  const PhotonScene scene(test::box(3, glm::vec3(0.0f), glm::vec3(1.0f), true));
  std::mt19937 random(4);
  auto photons = test::uniformPhotons(scene, 60000, glm::vec3(1.0f), random);
  std::erase_if(photons, [&](const Photon& p) { return scene.regions.regionOf[p.triangle] != 0; });
  ASSERT_GT(photons.size(), 5000u);
  std::vector<DensityQuery> queries;
  for (int i = 0; i < 3000; ++i) queries.push_back(test::randomQuery(scene, 0.6, random));
  for (const int nearest : {0, 20}) {
    const auto found = test::estimate(scene, photons, queries, {.nearest = nearest});
    for (std::size_t i = 0; i < queries.size(); ++i)
      ASSERT_EQ(found[i].x > 0.0f, scene.regions.regionOf[queries[i].triangle] == 0) << i;
  }
}

TEST(Density, SidesOfASurface_AreKeptApart) {
  const PhotonScene scene(test::ground(1, 1.0f));
  std::mt19937 random(4);
  std::vector<Photon> photons;
  std::uniform_real_distribution<double> place(-1.0, 1.0);
  for (int i = 0; i < 2000; ++i) {
    const glm::dvec3 at(place(random), 0.0, place(random));
    photons.push_back(
        photonAt(scene, 0, at, i % 4 == 0 ? glm::vec3(1, 0, 0) : glm::vec3(0, 1, 0), i % 4 == 0));
  }
  const glm::dvec3 centre(0.1, 0.0, 0.2);
  const std::vector<DensityQuery> queries = {queryAt(scene, 0, centre, 0.5),
                                             queryAt(scene, 0, centre, 0.5, true)};
  const auto found = test::estimate(scene, photons, queries, {});
  EXPECT_NEAR(found[0].y, 1500.0 / 4.0, 60.0);
  EXPECT_EQ(found[0].x, 0.0f);
  EXPECT_NEAR(found[1].x, 500.0 / 4.0, 35.0);
  EXPECT_EQ(found[1].y, 0.0f);
}

TEST(Density, NoPhotons_IsDark) {
  const PhotonScene scene(test::box(1, glm::vec3(0.0f), glm::vec3(1.0f), true));
  std::mt19937 random(4);
  std::vector<DensityQuery> queries;
  for (int i = 0; i < 100; ++i) queries.push_back(test::randomQuery(scene, 0.3, random));
  for (const int nearest : {0, 5})
    for (const glm::vec3& irradiance : test::estimate(scene, {}, queries, {.nearest = nearest}))
      ASSERT_EQ(irradiance, glm::vec3(0.0f));
  DensityEstimator untold(scene.surface, {}, test::sharedDevice());
  EXPECT_EQ(untold.estimate(queries)[0], glm::vec3(0.0f));
  EXPECT_TRUE(untold.estimate({}).empty());
}

TEST(Density, OnePhoton_IsItsKernel) {
  const PhotonScene scene(test::ground(1, 10.0f));
  const std::vector<Photon> photons = {photonAt(scene, 0, {1.0, 0.0, 2.0}, {3.0f, 1.0f, 0.0f})};
  for (const DensityKernel kernel : kernels)
    for (const double distance : {0.0, 0.3, 0.7, 0.99, 1.01}) {
      const std::vector<DensityQuery> queries = {queryAt(scene, 0, {1.0 + distance, 0.0, 2.0}, 1.0)};
      const double weight = distance > 1.0                      ? 0.0
                            : kernel == DensityKernel::Constant ? 1.0
                            : kernel == DensityKernel::Cone     ? 1.0 - distance
                                                                : 1.0 - distance * distance;
      const auto found = test::estimate(scene, photons, queries, {.kernel = kernel});
      EXPECT_NEAR(found[0].x, 3.0 * weight / discIntegral(kernel), 2e-6);
      EXPECT_NEAR(found[0].y, weight / discIntegral(kernel), 1e-6);
    }
}

TEST(Density, PhotonsAtOnePlace_AreFiniteAndKeepTheirPower) {
  const PhotonScene scene(test::ground(1, 10.0f));
  const std::vector<Photon> photons(10000, photonAt(scene, 0, {1.0, 0.0, 2.0}, glm::vec3(1e-4f)));
  const std::vector<DensityQuery> queries = {queryAt(scene, 0, {1.0, 0.0, 2.0}, 1.0),
                                             queryAt(scene, 0, {1.5, 0.0, 2.0}, 1.0)};
  const double whole = 1.0 / discIntegral(DensityKernel::Epanechnikov);
  const auto fixed = test::estimate(scene, photons, queries, {});
  EXPECT_NEAR(fixed[0].x, whole, 1e-4 * whole);
  EXPECT_NEAR(fixed[1].x, 0.75 * whole, 1e-4 * whole);
  const auto bounded = test::estimate(scene, photons, queries, {.nearest = 50, .minRadius = 0.1});
  EXPECT_NEAR(bounded[0].x, 100.0 * whole, 1e-2 * whole);
  const auto unbounded = test::estimate(scene, photons, queries, {.nearest = 50});
  EXPECT_NEAR(unbounded[0].x / whole, 1e10, 1e7);  // A hundred-thousandth of the radius.
}

TEST(Density, Scale_ChangesNothingButTheUnit) {
  const auto scaled = [](double scale) {
    CompiledScene sheet = wavySheet(12, 0.2);
    for (glm::vec3& p : sheet.positions) p *= static_cast<float>(scale);
    return PhotonScene(sheet);
  };
  const auto irradiance = [&](double scale, int nearest) {
    const PhotonScene scene = scaled(scale);
    std::mt19937 random(2);
    const auto photons =
        test::uniformPhotons(scene, 4000, glm::vec3(static_cast<float>(scale * scale)), random);
    std::vector<DensityQuery> queries;
    for (int i = 0; i < 200; ++i) queries.push_back(test::randomQuery(scene, 0.3 * scale, random));
    return test::estimate(scene, photons, queries, {.nearest = nearest});
  };
  for (const int nearest : {0, 60}) {
    const auto one = irradiance(1.0, nearest);
    for (const double scale : {1e-3, 1e5}) {
      const auto other = irradiance(scale, nearest);
      for (std::size_t i = 0; i < one.size(); ++i)
        ASSERT_NEAR(other[i].x, one[i].x, 2e-3f * one[i].x) << scale << ' ' << i;
    }
  }
}

TEST(Density, SamePhotons_GiveTheSameBits) {
  const PhotonScene scene(test::sphere(16, 1.0f, {0, 0, 0}));
  std::mt19937 random(9);
  const auto photons = test::uniformPhotons(scene, 50000, glm::vec3(0.37f, 1.1f, 1e-3f), random);
  std::vector<DensityQuery> queries;
  for (int i = 0; i < 500; ++i) queries.push_back(test::randomQuery(scene, 0.2, random));
  for (const int nearest : {0, 33}) {
    const auto one = test::estimate(scene, photons, queries, {.nearest = nearest});
    const auto other = test::estimate(scene, photons, queries, {.nearest = nearest});
    EXPECT_EQ(std::memcmp(one.data(), other.data(), one.size() * sizeof(glm::vec3)), 0);
  }
}

TEST(Density, UnsoundPhotonsAndOptions_AreErrors) {
  const PhotonScene scene(test::ground(1, 1.0f));
  const Photon sound = photonAt(scene, 0, {0, 0, 0}, glm::vec3(1.0f));
  Photon nowhere = sound, endless = sound, negative = sound, beyond = sound;
  nowhere.position[1] = NAN;
  endless.power[2] = INFINITY;
  negative.power[0] = -1.0f;
  beyond.triangle = 2;
  for (const Photon& photon : {nowhere, endless, negative, beyond}) {
    const std::vector<Photon> photons = {sound, sound, photon, photon};
    try {
      makePhotonMaps(photons, scene.surface);
      FAIL();
    } catch (const InputError& error) {
      EXPECT_EQ(std::string(error.what()).rfind("photon 2:", 0), 0u) << error.what();
    }
  }
  for (const DensityOptions& options : {DensityOptions{.nearest = 1}, DensityOptions{.nearest = 5000},
                                        DensityOptions{.minRadius = -1.0}, DensityOptions{.flatness = 0.0}})
    EXPECT_THROW(DensityEstimator(scene.surface, options, test::sharedDevice()), UsageError);
}

/// All photons arrive from one direction at a cosine c: irradiance is E, and the integral of radiance is E /
/// c along that direction.
TEST(Density, PhotonsOfOneDirection_TellIt) {
  const PhotonScene scene(test::ground(4, 1.0f));
  std::mt19937 random(7);
  auto photons = test::uniformPhotons(scene, 20000, {1e-3f, 2e-3f, 0.0f}, random);
  const glm::dvec3 way = glm::normalize(glm::dvec3(0.8, 0.5, -0.3));
  for (Photon& photon : photons) photon.direction = packDirection(way);
  const std::vector<DensityQuery> queries = {queryAt(scene, 10, scene.pointOn(10, 0.3, 0.3), 0.3),
                                             queryAt(scene, 20, scene.pointOn(20, 0.2, 0.5), 0.3)};
  for (const int nearest : {0, 100}) {
    DensityOptions options;
    options.nearest = nearest;
    DensityEstimator estimator(scene.surface, options, test::sharedDevice());
    estimator.setPhotons(makePhotonMaps(photons, scene.surface));
    const auto irradiance = estimator.estimate(queries);
    const auto incident = estimator.estimateIncident(queries);
    ASSERT_EQ(incident.size(), 15 * queries.size());
    const double constant = std::sqrt(1.0 / (4.0 * pi)), linear = std::sqrt(3.0 / (4.0 * pi));
    const double factors[] = {1.0, constant / way.y, linear, linear * way.z / way.y, linear * way.x / way.y};
    for (std::size_t q = 0; q < queries.size(); ++q)
      for (std::size_t k = 0; k < 5; ++k) {
        const double red = static_cast<double>(irradiance[q].x) * factors[k];
        EXPECT_NEAR(incident[15 * q + k], red, 1e-3 * irradiance[q].x) << k;
        EXPECT_NEAR(incident[15 * q + 5 + k], 2.0 * red, 2e-3 * irradiance[q].x) << k;
        EXPECT_EQ(incident[15 * q + 10 + k], 0.0f);
      }
    const auto further = estimator.estimateIncident(queries, 5);
    ASSERT_EQ(further.size(), 78 * queries.size());
    std::array<double, 25> functions{};
    sh::evaluate(way, 5, functions);
    for (std::size_t q = 0; q < queries.size(); ++q) {
      EXPECT_EQ(further[78 * q], incident[15 * q]);
      for (std::size_t k = 0; k < 25; ++k)
        EXPECT_NEAR(further[78 * q + 1 + k], irradiance[q].x * functions[k] / way.y, 2e-3 * irradiance[q].x)
            << k;
    }
  }
}

}  // namespace
}  // namespace prelight
