#pragma once

#include <cstdint>
#include <functional>
#include <glm/glm.hpp>
#include <limits>
#include <span>

#include "prelight/transfer.h"

namespace prelight {

/// What a light sends to a point.
struct IncidentLight {
  glm::dvec3 irradiance{0.0};                                 ///< on a surface that faces it, W/m2
  glm::dvec3 toLight{0.0, 1.0, 0.0};                          ///< unit
  double distance = std::numeric_limits<double>::infinity();  ///< m
  bool highlights = true;                                     ///< glossy receivers show it
};

/// A light, asked at points in world space.
using LightAt = std::function<IncidentLight(const glm::dvec3&)>;

enum class OccluderFormula : std::uint8_t {
  Soft,    ///< the blobs of all occluders are added up, and a threshold makes shadows of them
           ///< (docs/occluders.md)
  Thesis,  ///< product of sin^(2 N F) (Sherif 2013, Eq. 7.2 and 7.3)
};

/// What occluders mirror.
enum class MirrorFormula : std::uint8_t {
  Lobe,    ///< lobes of unit integral, as wide as the mirror is large and bent (docs/occluders.md)
  Thesis,  ///< powers of cosines and of form factors (Sherif 2013, listing A.2)
};

/// How a receiver scatters what it does not reflect.
enum class DiffuseReceiver : std::uint8_t { Lambert, OrenNayar };

/// Effects that move over time (Sherif 2013, 7.3). All repeat after a period.
struct OccluderEffects {
  double waves = 0.0;        ///< >= 0: tangent of the largest angle that occlusion and caustics are bent by
  double length = 1.0;       ///< of the longest wave, m
  double fire = 0.0;         ///< >= 0: part of the lights' strength that flickers
  double moment = 0.0;       ///< of the period, [0,1)
  double normalWaves = 0.0;  ///< >= 0: as `waves`, of the normals that light falls on (Figure 1.4)

  bool operator==(const OccluderEffects&) const = default;
};

/// How vector occluders are shaded.
struct OccluderShading {
  OccluderFormula formula = OccluderFormula::Soft;
  double shadowStrength = 2.0;   ///< N_sh of Eq. 7.2, >= 0, of the thesis' formula alone; it shows 0.2 to 5.5
  double bleeding = 1.0;         ///< of colour from diffuse surfaces; below 0 drains it
  double causticStrength = 1.0;  ///< >= 0: factor of light along the caustics' way; N_c of Eq. 7.3
  double diffuseFromSpecular = 1.0;   ///< >= 0: factor of what occluders mirror to diffuse receivers
  double specularFromSpecular = 1.0;  ///< >= 0: the same to glossy ones
  double specularExponent = 100.0;    ///< >= 1: cosine power of a flat, small mirror; A.2's of all
  MirrorFormula mirrors = MirrorFormula::Lobe;
  DiffuseReceiver receiver = DiffuseReceiver::Lambert;
  OccluderEffects effects = {};

  bool operator==(const OccluderShading&) const = default;
};

constexpr int defaultSkyLights = 32;  ///< that stand for a sky, as in the thesis' Figure 7.24

/// A vertex that is shaded.
struct OccluderReceiver {
  std::uint32_t vertex = 0;
  glm::dvec3 position{0.0};  ///< world
  glm::dvec3 normal{0.0};    ///< unit
  glm::dvec3 origin{0.0};    ///< world, from which waves are counted
  glm::dvec3 toEye{0.0};     ///< unit; of glossy and rough receivers
  glm::dvec3 f0{0.0};        ///< reflectance along the normal; 0: nothing but diffuse
  double roughness = 1.0;    ///< [0,1]
};

/// Light of a vertex.
struct OccludedLight {
  glm::dvec3 diffuse{0.0};    ///< before the albedo: exit radiance is the albedo times it
  glm::dvec3 specular{0.0};   ///< radiance to the eye: the lights' reflection, with shadows
  glm::dvec3 reflected{0.0};  ///< the same of what occluders mirror (specular from specular)
  double highlight = 1.0;     ///< share of the lights' reflection that shadows leave
};

/// Share of a light, in [0,1], that the occluders of a vertex let through, were all of them opaque. The
/// transfer must hold occlusion, and for the soft formula positions and diffuse normals.
double visibilityOf(const OccluderTransfer& transfer, const OccluderReceiver& receiver,
                    const IncidentLight& light, const OccluderShading& shading);

/// Light of a vertex: every light, shadowed by all occluders, with what each occluder's lit surface sends on,
/// what comes through it and what it mirrors, as far as the transfer holds the vectors for it (Sherif 2013,
/// 7.2 to 7.3). The transfer must hold positions, occlusion, diffuse normals and colours. Finite and not
/// negative. This is the slow, double-precision answer that kernels/relight/occluder_*.cl is compared with.
OccludedLight litThroughOccluders(const OccluderTransfer& transfer, const OccluderReceiver& receiver,
                                  std::span<const LightAt> lights, const OccluderShading& shading);

}  // namespace prelight
