#include "benchmarks/suites/indirect/photon_samples.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "base/directions.h"

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

}  // namespace prelight::benchmarks
