#pragma once

#include <glm/glm.hpp>
#include <random>
#include <span>
#include <vector>

#include "photon/density_estimator.h"
#include "prelight/compiled_scene.h"
#include "scene/surface/surface_regions.h"
#include "shared/density_types.h"
#include "shared/photon_types.h"

namespace prelight::test {

/// A scene with the data that density estimation needs.
struct PhotonScene {
  explicit PhotonScene(CompiledScene made, double creaseAngle = usualCreaseAngle);

  glm::dvec3 normalOf(std::uint32_t triangle) const;  ///< Unit normal.
  glm::dvec3 pointOn(std::uint32_t triangle, double u, double v) const;

  CompiledScene scene;
  SurfaceRegions regions;
  DensitySurface surface;
  std::vector<double> areaSums;  ///< [triangle], area of all triangles up to and including it.
};

/// A photon that arrived from straight above on the front of a triangle, or on its back.
device::Photon photonAt(const PhotonScene& scene, std::uint32_t triangle, const glm::dvec3& position,
                        const glm::vec3& power, bool back = false);

/// `count` photons, each of `power`, independent and uniform over the fronts of all triangles.
std::vector<device::Photon> uniformPhotons(const PhotonScene& scene, std::size_t count,
                                           const glm::vec3& power, std::mt19937& random);

device::DensityQuery queryAt(const PhotonScene& scene, std::uint32_t triangle, const glm::dvec3& position,
                             double radius, bool back = false);

/// A query at a random point on the front of any triangle.
device::DensityQuery randomQuery(const PhotonScene& scene, double radius, std::mt19937& random);

std::vector<glm::vec3> estimate(const PhotonScene& scene, std::span<const device::Photon> photons,
                                std::span<const device::DensityQuery> queries, const DensityOptions& options);

/// Reference estimate in double precision from all photons. It splits all triangles into pieces, `pieces` per
/// radius.
glm::dvec3 bruteIrradiance(const PhotonScene& scene, std::span<const device::Photon> photons,
                           const device::DensityQuery& query, const DensityOptions& options,
                           int pieces = 100);

}  // namespace prelight::test
