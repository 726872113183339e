#pragma once

#include <glm/glm.hpp>
#include <random>
#include <span>
#include <vector>

#include "photon/density_estimator.h"
#include "prelight/compiled_scene.h"
#include "scene/surface_regions.h"
#include "shared/density_types.h"
#include "shared/photon_types.h"

namespace prelight::test {

/// A scene with what density estimation needs to know of it.
struct PhotonScene {
  explicit PhotonScene(CompiledScene made, double creaseAngle = usualCreaseAngle);

  glm::dvec3 normalOf(std::uint32_t triangle) const;  ///< unit
  glm::dvec3 pointOn(std::uint32_t triangle, double u, double v) const;

  CompiledScene scene;
  SurfaceRegions regions;
  DensitySurface surface;
  std::vector<double> areaSums;  ///< [triangle] up to and with it
};

/// A photon on the front of a triangle, or its back, from straight above.
device::Photon photonAt(const PhotonScene& scene, std::uint32_t triangle, const glm::dvec3& position,
                        const glm::vec3& power, bool back = false);

/// As many photons, each of `power`, independent and uniform over the fronts of all triangles.
std::vector<device::Photon> uniformPhotons(const PhotonScene& scene, std::size_t count,
                                           const glm::vec3& power, std::mt19937& random);

device::DensityQuery queryAt(const PhotonScene& scene, std::uint32_t triangle, const glm::dvec3& position,
                             double radius, bool back = false);

/// A query at a random point of the front of any triangle.
device::DensityQuery randomQuery(const PhotonScene& scene, double radius, std::mt19937& random);

std::vector<glm::vec3> estimate(const PhotonScene& scene, std::span<const device::Photon> photons,
                                std::span<const device::DensityQuery> queries, const DensityOptions& options);

/// The same by all photons and by cutting all triangles into pieces, in double precision; `pieces` a radius.
glm::dvec3 bruteIrradiance(const PhotonScene& scene, std::span<const device::Photon> photons,
                           const device::DensityQuery& query, const DensityOptions& options,
                           int pieces = 100);

}  // namespace prelight::test
