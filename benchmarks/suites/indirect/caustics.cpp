#include "benchmarks/suites/indirect/caustics.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <ctime>
#include <numbers>
#include <numeric>

#include "base/directions.h"
#include "base/parallel.h"
#include "benchmarks/run/measure.h"
#include "photon/caustic_light.h"

namespace prelight::benchmarks {

using device::DensityQuery;
using device::Photon;

CompiledScene makeSquares(std::size_t count) {
  CompiledScene scene;
  for (std::size_t i = 0; i < count; ++i) {
    const float left = 2.0f * static_cast<float>(i);
    const auto first = static_cast<std::uint32_t>(scene.positions.size());
    for (const glm::vec3& corner :
         {glm::vec3(0, 0, 0), glm::vec3(0, 0, 1), glm::vec3(1, 0, 1), glm::vec3(1, 0, 0)})
      scene.positions.push_back(corner + glm::vec3(left, 0, 0));
    scene.triangles.push_back({first, first + 1, first + 2});
    scene.triangles.push_back({first, first + 2, first + 3});
  }
  scene.normals.assign(scene.positions.size(), glm::vec3(0, 1, 0));
  scene.texCoords.assign(scene.positions.size(), glm::vec2(0));
  scene.triangleMaterials.assign(scene.triangles.size(), 0);
  scene.triangleFlat.assign(scene.triangles.size(), 0);
  scene.materials.resize(1);
  scene.boundsMax = glm::vec3(2.0f * static_cast<float>(count), 0, 1);
  return scene;
}

SurfaceRegions wholeRegion(const CompiledScene& scene) {
  SurfaceRegions regions{std::vector<std::uint32_t>(scene.triangleCount(), 0), {0.0}};
  for (std::uint32_t t = 0; t < scene.triangleCount(); ++t)
    regions.areas[0] += 0.5 * glm::length(geometricNormal(scene, t));
  return regions;
}

Photon makePhoton(const glm::dvec3& position, std::uint32_t triangle, double power) {
  const float watts = static_cast<float>(power);
  return {{static_cast<float>(position.x), static_cast<float>(position.y), static_cast<float>(position.z)},
          triangle,
          {watts, watts, watts},
          packDirection({0, 1, 0})};
}

std::vector<Photon> photonsInCube(std::size_t count, std::size_t squares, std::mt19937& random) {
  std::uniform_real_distribution<double> unit;
  std::vector<Photon> photons;
  for (std::size_t i = 0; i < count; ++i) {
    const double x = unit(random), y = unit(random), z = unit(random);
    photons.push_back(makePhoton({x, y, z}, static_cast<std::uint32_t>(2 * (i % squares)),
                                 1.0 / static_cast<double>(count)));
  }
  return photons;
}

std::vector<Photon> photonsOnSquare(std::size_t count, bool spot, std::mt19937& random) {
  std::uniform_real_distribution<double> unit;
  std::normal_distribution<double> near(0.0, 0.02);
  std::vector<Photon> photons;
  for (std::size_t i = 0; i < count; ++i) {
    glm::dvec3 at(unit(random), 0.0, unit(random));
    if (spot && i % 2 == 0)
      at = {std::clamp(0.6 + near(random), 0.0, 1.0), 0.0, std::clamp(0.4 + near(random), 0.0, 1.0)};
    photons.push_back(makePhoton(at, at.z > at.x ? 0 : 1, 1.0 / static_cast<double>(count)));
  }
  return photons;
}

std::vector<Photon> photonsOnScene(const CompiledScene& scene, std::size_t count, std::mt19937& random) {
  std::vector<double> sums;
  for (std::uint32_t t = 0; t < scene.triangleCount(); ++t)
    sums.push_back((sums.empty() ? 0.0 : sums.back()) + 0.5 * glm::length(geometricNormal(scene, t)));
  std::uniform_real_distribution<double> unit;
  std::vector<Photon> photons;
  for (std::size_t i = 0; i < count; ++i) {
    const auto above = std::upper_bound(sums.begin(), sums.end(), unit(random) * sums.back());
    const auto t =
        static_cast<std::uint32_t>(std::min<std::ptrdiff_t>(above - sums.begin(), scene.triangleCount() - 1));
    const glm::uvec3 c = scene.triangles[t];
    const double root = std::sqrt(unit(random)), v = unit(random);
    const glm::dvec3 at = (1.0 - root) * glm::dvec3(scene.positions[c.x]) +
                          root * (1.0 - v) * glm::dvec3(scene.positions[c.y]) +
                          root * v * glm::dvec3(scene.positions[c.z]);
    Photon photon = makePhoton(at, t, 1.0 / static_cast<double>(count));
    photon.direction = packDirection(geometricNormal(scene, t));
    photons.push_back(photon);
  }
  return photons;
}

std::vector<DensityQuery> queriesAtPhotons(std::span<const Photon> photons, std::size_t count,
                                           double radius) {
  std::vector<DensityQuery> queries;
  for (std::size_t i = 0; i < count; ++i) {
    const Photon& photon = photons[i * photons.size() / count];
    const glm::vec3 side(unpackDirection(photon.direction));
    DensityQuery query{
        {}, photon.triangle, {side.x, side.y, side.z}, static_cast<float>(radius), PRELIGHT_WHOLE_REGION};
    std::copy_n(photon.position, 3, query.position);
    queries.push_back(query);
  }
  return queries;
}

namespace {

using std::numbers::pi;
constexpr double radius = 0.5;  // m

/// Returns 0 if the light reflected at angle `a` passes over (x, z) of the unit circle.
double missing(double a, double x, double z) {
  return -x * std::sin(2.0 * a) + z * std::cos(2.0 * a) + std::sin(a);
}

/// Returns the angle at which `missing` is 0, between two angles of different signs.
double hitBetween(double low, double high, double x, double z) {
  const bool rising = missing(low, x, z) < 0.0;
  for (int step = 0; step < 50; ++step) {
    const double middle = 0.5 * (low + high);
    ((missing(middle, x, z) < 0.0) == rising ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

}  // namespace

std::vector<device::Photon> MirroredCylinder::photons(std::size_t count, std::mt19937& random) {
  std::uniform_real_distribution<double> unit;
  std::vector<device::Photon> photons;
  while (photons.size() < count) {
    const double a = pi * (unit(random) - 0.5), cosine = std::cos(a);
    if (unit(random) >= cosine * cosine) continue;
    const double s = 2.0 * cosine * unit(random);
    const double x = 0.5 + radius * (cosine - s * std::cos(2.0 * a));
    const double z = 0.5 + radius * (std::sin(a) - s * std::sin(2.0 * a));
    photons.push_back(makePhoton({x, 0.0, z}, z > x ? 0 : 1, 1.0 / static_cast<double>(count)));
  }
  return photons;
}

double MirroredCylinder::irradiance(double x, double z) {
  const double u = (x - 0.5) / radius, v = (z - 0.5) / radius;
  if (u * u + v * v >= 1.0) return 0.0;
  constexpr int steps = 256;
  double sum = 0.0, before = missing(-0.5 * pi, u, v);
  for (int i = 1; i <= steps; ++i) {
    const double low = pi * (static_cast<double>(i - 1) / steps - 0.5),
                 high = pi * (static_cast<double>(i) / steps - 0.5);
    const double after = missing(high, u, v);
    if ((before < 0.0) != (after < 0.0)) {
      const double a = hitBetween(low, high, u, v);
      const double s = (std::cos(a) - u) * std::cos(2.0 * a) + (std::sin(a) - v) * std::sin(2.0 * a);
      if (s >= 0.0) sum += std::cos(a) / (pi * std::abs(std::cos(a) - 2.0 * s));
    }
    before = after;
  }
  return sum / (radius * radius);
}

namespace {

using device::DensityQuery;

constexpr int subPixels = 4;      // per side of a pixel, for the truth
constexpr double trusted = 0.99;  // share of pixels that count; the others lie on the infinite caustic

/// Trial of a picture of the cylinder's floor from above.
class CausticTrial {
 public:
  CausticTrial(const Device& device, const IndirectOptions& options)
      : device_(device), options_(options), side_(options.causticSide) {
    const CompiledScene scene = makeSquares(1);
    surface_ = makeDensitySurface(scene, wholeRegion(scene));
    truth_.resize(static_cast<std::size_t>(side_ * side_));
    parallelRanges(truth_.size(), 256, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) truth_[i] = meanIrradiance(i);
    });
  }

  void run(std::size_t count, std::vector<BenchmarkResult>& results) {
    std::mt19937 random(1);
    const std::vector<device::Photon> photons = MirroredCylinder::photons(count, random);
    const PhotonMaps maps = makePhotonMaps(photons, surface_);
    const CausticFilter chosen = chooseCausticFilter(maps, 1.0 / side_);
    add(fmt::format("caustic/{}/chosen", count), maps, chosen, results);
    for (const int nearest : options_.causticNearest) {
      CausticFilter filter = chosen;
      filter.density.nearest = nearest;
      filter.radius = chosen.radius * std::sqrt(static_cast<double>(nearest) / chosen.density.nearest);
      add(fmt::format("caustic/{}/k {}", count, nearest), maps, filter, results);
      filter.density.kernel = DensityKernel::Cone;
      add(fmt::format("caustic/{}/k {}, cone", count, nearest), maps, filter, results);
      filter.density.kernel = DensityKernel::Constant;
      add(fmt::format("caustic/{}/k {}, constant", count, nearest), maps, filter, results);
    }
    for (const double pixels : options_.causticRadii)
      add(fmt::format("caustic/{}/radius of {} pixels", count, pixels), maps, {{}, pixels / side_}, results);
  }

 private:
  double meanIrradiance(std::size_t pixel) const {
    const auto x = static_cast<double>(pixel % static_cast<std::size_t>(side_));
    const auto z = static_cast<double>(pixel / static_cast<std::size_t>(side_));
    double sum = 0.0;
    for (int j = 0; j < subPixels; ++j)
      for (int i = 0; i < subPixels; ++i)
        sum += MirroredCylinder::irradiance((x + (i + 0.5) / subPixels) / side_,
                                            (z + (j + 0.5) / subPixels) / side_);
    return sum / (subPixels * subPixels);
  }

  void add(const std::string& name, const PhotonMaps& maps, const CausticFilter& filter,
           std::vector<BenchmarkResult>& results) {
    DensityEstimator estimator(surface_, filter.density, device_);
    estimator.setPhotons(maps);
    std::vector<DensityQuery> queries;
    for (int z = 0; z < side_; ++z)
      for (int x = 0; x < side_; ++x) {
        const float u = (static_cast<float>(x) + 0.5f) / static_cast<float>(side_);
        const float v = (static_cast<float>(z) + 0.5f) / static_cast<float>(side_);
        queries.push_back({{u, 0.0f, v},
                           v > u ? 0u : 1u,
                           {0, 1, 0},
                           static_cast<float>(filter.radius),
                           PRELIGHT_WHOLE_REGION});
      }
    std::vector<glm::vec3> found = estimator.estimate(queries);
    const std::clock_t before = std::clock();
    found = estimator.estimate(queries);
    const double seconds = static_cast<double>(std::clock() - before) / CLOCKS_PER_SEC;
    results.push_back({name, "relMSE", relativeError(found), "1", {}, {}});
    results.push_back({name, "processor time", seconds, "s", {}, {}});
  }

  /// Returns the error over the pixels within the cylinder, without those of largest error.
  double relativeError(const std::vector<glm::vec3>& found) const {
    double squares = 0.0;
    for (const double truth : truth_) squares += std::min(truth, 20.0) * std::min(truth, 20.0);
    const double floor = 0.01 * squares / static_cast<double>(truth_.size());
    std::vector<double> errors;
    for (std::size_t i = 0; i < found.size(); ++i)
      if (truth_[i] > 0.0)
        errors.push_back(std::pow(static_cast<double>(found[i].x) - truth_[i], 2.0) /
                         (truth_[i] * truth_[i] + floor));
    std::sort(errors.begin(), errors.end());
    errors.resize(static_cast<std::size_t>(trusted * static_cast<double>(errors.size())));
    double sum = 0.0;
    for (const double error : errors) sum += error;
    return sum / static_cast<double>(errors.size());
  }

  const Device& device_;
  const IndirectOptions& options_;
  int side_;
  DensitySurface surface_;
  std::vector<double> truth_;  ///< [pixel]
};

}  // namespace

void measureCaustic(const Device& device, const IndirectOptions& options,
                    std::vector<BenchmarkResult>& results) {
  CausticTrial trial(device, options);
  for (const std::uint64_t count : options.causticPhotons) trial.run(count, results);
}

}  // namespace prelight::benchmarks
