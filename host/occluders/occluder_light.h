#pragma once

#include <cstdint>
#include <functional>
#include <glm/glm.hpp>
#include <limits>
#include <span>

#include "prelight/shading.h"
#include "prelight/transfer.h"

namespace prelight {

/// Light arriving at a point from one light.
struct IncidentLight {
  glm::dvec3 irradiance{0.0};         ///< irradiance on a surface that faces the light, W/m2
  glm::dvec3 toLight{0.0, 1.0, 0.0};  ///< unit
  double distance = std::numeric_limits<double>::infinity();  ///< m
  bool highlights = true;                                     ///< whether glossy receivers show the light
};

/// A light as a function of the point in world space.
using LightAt = std::function<IncidentLight(const glm::dvec3&)>;

/// A vertex to shade.
struct OccluderReceiver {
  std::uint32_t vertex = 0;
  glm::dvec3 position{0.0};  ///< world
  glm::dvec3 normal{0.0};    ///< unit
  glm::dvec3 origin{0.0};    ///< world, reference point of the waves
  glm::dvec3 toEye{0.0};     ///< unit; used by glossy and rough receivers
  glm::dvec3 f0{0.0};        ///< reflectance along the normal; 0: purely diffuse
  double roughness = 1.0;    ///< [0,1]
};

/// Light at a vertex.
struct OccludedLight {
  glm::dvec3 diffuse{0.0};    ///< before the albedo: exit radiance is the albedo times this
  glm::dvec3 specular{0.0};   ///< radiance to the eye due to reflections of lights, with shadows
  glm::dvec3 reflected{0.0};  ///< radiance to the eye due to mirroring occluders (specular from specular)
  double highlight = 1.0;     ///< share of the lights' reflections that is not shadowed
};

/// Returns the share of a light, in [0,1], that reaches a vertex if all its occluders are opaque. The
/// transfer must hold occlusion and, for the soft formula, positions and diffuse normals.
double visibilityOf(const OccluderTransfer& transfer, const OccluderReceiver& receiver,
                    const IncidentLight& light, const OccluderShading& shading);

/// Returns the light at a vertex: every light, shadowed by all occluders, and the light that each occluder
/// reflects diffusely, transmits and mirrors, as far as the transfer holds the vectors for it (Sherif 2013,
/// 7.2 to 7.3). The transfer must hold positions, occlusion, diffuse normals and colours. The result is
/// finite and not negative. This is the slow double-precision oracle of host/techniques/vector_occluders.
OccludedLight litThroughOccluders(const OccluderTransfer& transfer, const OccluderReceiver& receiver,
                                  std::span<const LightAt> lights, const OccluderShading& shading);

}  // namespace prelight
