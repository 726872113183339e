#pragma once

#include <cstdint>
#include <functional>
#include <glm/glm.hpp>
#include <limits>
#include <span>

#include "bake/transfer.h"

namespace prelight {

/// What a light sends to a point.
struct IncidentLight {
  glm::dvec3 irradiance{0.0};                                 ///< on a surface that faces it, W/m2
  glm::dvec3 toLight{0.0, 1.0, 0.0};                          ///< unit
  double distance = std::numeric_limits<double>::infinity();  ///< m
};

/// A light, asked at points in world space.
using LightAt = std::function<IncidentLight(const glm::dvec3&)>;

enum class OccluderFormula : std::uint8_t {
  Soft,    ///< the blobs of all occluders are added up, and a threshold makes shadows of them
           ///< (docs/occluders.md)
  Thesis,  ///< product of sin^(2 N F) (Sherif 2013, Eq. 7.2)
};

/// How vector occluders are shaded.
struct OccluderShading {
  OccluderFormula formula = OccluderFormula::Soft;
  double shadowStrength = 2.0;  ///< N_sh of Eq. 7.2, >= 0, of the thesis' formula alone; it shows 0.2 to 5.5
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

/// Share of a light, in [0,1], that the occluders of a vertex let through. The transfer must hold occlusion,
/// and for the soft formula positions and diffuse normals.
double visibilityOf(const OccluderTransfer& transfer, const OccluderReceiver& receiver,
                    const IncidentLight& light, const OccluderShading& shading);

/// Diffuse light of a vertex before its albedo (exit radiance is the albedo times it): every light, shadowed
/// by all occluders, and what each occluder's lit surface sends on (Sherif 2013, 7.2.4, diffuse from
/// diffuse). The transfer must hold positions, occlusion, diffuse normals and colours. Finite and not
/// negative.
glm::dvec3 lightThroughOccluders(const OccluderTransfer& transfer, const OccluderReceiver& receiver,
                                 std::span<const LightAt> lights, const OccluderShading& shading);

}  // namespace prelight
