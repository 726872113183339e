#pragma once

#include <cstdint>
#include <functional>
#include <glm/glm.hpp>
#include <span>

#include "bake/transfer.h"

namespace prelight {

/// What a light sends to a point.
struct IncidentLight {
  glm::dvec3 irradiance{0.0};         ///< on a surface that faces it, W/m2
  glm::dvec3 toLight{0.0, 1.0, 0.0};  ///< unit
};

/// A light, asked at points in world space.
using LightAt = std::function<IncidentLight(const glm::dvec3&)>;

/// How vector occluders are shaded (Sherif 2013, 7.2 and A.2).
struct OccluderShading {
  double shadowStrength = 2.0;  ///< N_sh of Eq. 7.2, >= 0; the thesis shows 0.2 to 5.5
  double bleeding = 1.0;        ///< of colour from diffuse surfaces, >= 0

  bool operator==(const OccluderShading&) const = default;
};

constexpr int defaultSkyLights = 32;  ///< that stand for a sky, as in the thesis' Figure 7.24

/// A vertex that is shaded.
struct OccluderReceiver {
  std::uint32_t vertex = 0;
  glm::dvec3 position{0.0};  ///< world
  glm::dvec3 normal{0.0};    ///< unit
};

/// Share of the light from a unit direction that an occluder lets through: sin^(2 N F) of the angle between
/// it and the occlusion vector where that is acute, else 1 (Eq. 7.2). In [0,1] whatever the vectors.
double occluderVisibility(const glm::vec4& occlusion, const glm::dvec3& toLight, double shadowStrength);

/// Diffuse light of a vertex before its albedo (exit radiance is the albedo times it): every light, shadowed
/// by each occluder, and what each occluder's lit surface sends on (7.2.4, diffuse from diffuse). The
/// transfer must hold positions, occlusion, diffuse normals and colours. Finite and not negative.
glm::dvec3 lightThroughOccluders(const OccluderTransfer& transfer, const OccluderReceiver& receiver,
                                 std::span<const LightAt> lights, const OccluderShading& shading);

}  // namespace prelight
