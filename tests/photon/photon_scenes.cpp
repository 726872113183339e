#include "photon/photon_scenes.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/directions.h"
#include "support/devices.h"

namespace prelight::test {

namespace {

using device::DensityQuery;
using device::Photon;

glm::dvec3 vec(const float* p) { return {p[0], p[1], p[2]}; }

double kernel(DensityKernel kind, double share) {
  if (share >= 1.0) return 0.0;
  if (kind == DensityKernel::Constant) return 1.0;
  return kind == DensityKernel::Cone ? 1.0 - share : 1.0 - share * share;
}

/// Distance of a point on a triangle from a query, as density estimation measures it; infinite if the point
/// never counts.
class Reach {
 public:
  Reach(const PhotonScene& scene, const DensityQuery& query, const DensityOptions& options)
      : scene_(scene),
        query_(query),
        options_(options),
        p_(vec(query.position)),
        n_(scene.normalOf(query.triangle)) {}

  double of(std::uint32_t triangle, const glm::dvec3& x) const {
    if (scene_.regions.regionOf[triangle] != scene_.regions.regionOf[query_.triangle]) return INFINITY;
    const glm::dvec3 normal = scene_.normalOf(triangle);
    if (glm::dot(normal, n_) < options_.leastCosine) return INFINITY;
    return std::max(glm::distance(x, p_), std::abs(glm::dot(x - p_, normal)) / options_.flatness);
  }

  /// Integral of the kernel of radius r over a triangle, which is split into four until the pieces are small.
  double integral(std::uint32_t triangle, const std::array<glm::dvec3, 3>& c, double r, double piece) const {
    const glm::dvec3 centre = (c[0] + c[1] + c[2]) / 3.0;
    double size = 0.0;
    for (const glm::dvec3& corner : c) size = std::max(size, glm::distance(corner, centre));
    if (glm::distance(centre, p_) > r + size) return 0.0;
    if (size < piece) {
      const double area = 0.5 * glm::length(glm::cross(c[1] - c[0], c[2] - c[0]));
      return of(triangle, centre) < r ? area * kernel(options_.kernel, glm::distance(centre, p_) / r) : 0.0;
    }
    const glm::dvec3 a = (c[1] + c[2]) / 2.0, b = (c[2] + c[0]) / 2.0, d = (c[0] + c[1]) / 2.0;
    return integral(triangle, {c[0], d, b}, r, piece) + integral(triangle, {d, c[1], a}, r, piece) +
           integral(triangle, {b, a, c[2]}, r, piece) + integral(triangle, {a, b, d}, r, piece);
  }

 private:
  const PhotonScene& scene_;
  const DensityQuery& query_;
  const DensityOptions& options_;
  glm::dvec3 p_, n_;
};

}  // namespace

PhotonScene::PhotonScene(CompiledScene made, double creaseAngle)
    : scene(std::move(made)),
      regions(makeSurfaceRegions(scene, creaseAngle)),
      surface(makeDensitySurface(scene, regions)) {
  double sum = 0.0;
  for (std::uint32_t t = 0; t < scene.triangleCount(); ++t)
    areaSums.push_back(sum += 0.5 * glm::length(geometricNormal(scene, t)));
}

glm::dvec3 PhotonScene::normalOf(std::uint32_t triangle) const {
  return glm::normalize(geometricNormal(scene, triangle));
}

glm::dvec3 PhotonScene::pointOn(std::uint32_t triangle, double u, double v) const {
  const glm::uvec3 corners = scene.triangles[triangle];
  const glm::dvec3 a(scene.positions[corners.x]), b(scene.positions[corners.y]),
      c(scene.positions[corners.z]);
  if (u + v > 1.0) return a + (1.0 - u) * (b - a) + (1.0 - v) * (c - a);
  return a + u * (b - a) + v * (c - a);
}

Photon photonAt(const PhotonScene& scene, std::uint32_t triangle, const glm::dvec3& position,
                const glm::vec3& power, bool back) {
  const glm::dvec3 normal = scene.normalOf(triangle);
  return {{static_cast<float>(position.x), static_cast<float>(position.y), static_cast<float>(position.z)},
          triangle,
          {power.x, power.y, power.z},
          packDirection(back ? -normal : normal)};
}

std::vector<Photon> uniformPhotons(const PhotonScene& scene, std::size_t count, const glm::vec3& power,
                                   std::mt19937& random) {
  std::uniform_real_distribution<double> unit;
  std::vector<Photon> photons;
  for (std::size_t i = 0; i < count; ++i) {
    const auto at =
        std::upper_bound(scene.areaSums.begin(), scene.areaSums.end(), unit(random) * scene.areaSums.back());
    const auto triangle = static_cast<std::uint32_t>(
        std::min<std::ptrdiff_t>(at - scene.areaSums.begin(), scene.scene.triangleCount() - 1));
    const double u = unit(random), v = unit(random);
    photons.push_back(photonAt(scene, triangle, scene.pointOn(triangle, u, v), power));
  }
  return photons;
}

DensityQuery queryAt(const PhotonScene& scene, std::uint32_t triangle, const glm::dvec3& position,
                     double radius, bool back) {
  const glm::vec3 normal(back ? -scene.normalOf(triangle) : scene.normalOf(triangle));
  return {{static_cast<float>(position.x), static_cast<float>(position.y), static_cast<float>(position.z)},
          triangle,
          {normal.x, normal.y, normal.z},
          static_cast<float>(radius),
          PRELIGHT_WHOLE_REGION};
}

DensityQuery randomQuery(const PhotonScene& scene, double radius, std::mt19937& random) {
  std::uniform_real_distribution<double> unit;
  const auto triangle = static_cast<std::uint32_t>(random() % scene.scene.triangleCount());
  const double u = unit(random), v = unit(random);
  return queryAt(scene, triangle, scene.pointOn(triangle, u, v), radius);
}

std::vector<glm::vec3> estimate(const PhotonScene& scene, std::span<const Photon> photons,
                                std::span<const DensityQuery> queries, const DensityOptions& options) {
  DensityEstimator estimator(scene.surface, options, sharedDevice());
  estimator.setPhotons(makePhotonMaps(photons, scene.surface));
  return estimator.estimate(queries);
}

glm::dvec3 bruteIrradiance(const PhotonScene& scene, std::span<const Photon> photons,
                           const DensityQuery& query, const DensityOptions& options, int pieces) {
  const Reach reach(scene, query, options);
  const bool back = glm::dot(vec(query.normal), scene.normalOf(query.triangle)) < 0.0;
  std::vector<double> reaches;
  std::vector<const Photon*> near;
  for (const Photon& photon : photons) {
    if ((glm::dot(unpackDirection(photon.direction), scene.normalOf(photon.triangle)) < 0.0) != back)
      continue;
    const double from = reach.of(photon.triangle, vec(photon.position));
    if (!(from < query.radius)) continue;
    near.push_back(&photon);
    reaches.push_back(from);
  }
  double r = query.radius;
  if (options.nearest > 0 && reaches.size() >= static_cast<std::size_t>(options.nearest)) {
    std::vector<double> sorted = reaches;
    std::sort(sorted.begin(), sorted.end());
    r = std::max(sorted[static_cast<std::size_t>(options.nearest) - 1], std::min(options.minRadius, r));
  }
  glm::dvec3 power(0.0);
  for (std::size_t i = 0; i < near.size(); ++i)
    if (reaches[i] < r)
      power += vec(near[i]->power) *
               kernel(options.kernel, glm::distance(vec(near[i]->position), vec(query.position)) / r);
  double area = 0.0;
  for (std::uint32_t t = 0; t < scene.scene.triangleCount(); ++t) {
    if (scene.regions.regionOf[t] != scene.regions.regionOf[query.triangle]) continue;
    area += reach.integral(t, {scene.pointOn(t, 0, 0), scene.pointOn(t, 1, 0), scene.pointOn(t, 0, 1)}, r,
                           r / pieces);
  }
  return area > 0.0 ? power / area : glm::dvec3(0.0);
}

}  // namespace prelight::test
