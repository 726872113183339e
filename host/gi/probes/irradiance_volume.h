#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "prelight/transfer.h"

namespace prelight {

/// Light at points in the air: what a diffuse surface with any normal gets there of the scene's own lights.
/// A probe belongs to the middle of every cell, and looks from a place nearby where that lies in an object.
struct IrradianceVolume {
  /// A side of a probe's map of surfaces, texels.
  static constexpr int surfaceSide = 8;

  VolumeGrid grid;
  int order = 3;                    ///< bands of SH, 1 to 3: irradiance has next to nothing of others
  std::vector<float> coefficients;  ///< [z][y][x][i][channel], incident radiance, W/(m2 sr), of which the
                                    ///< irradiance for a normal is sum pi clampedCosine(l) L_i Y_i(normal)
  std::vector<std::uint8_t> valid;  ///< [z][y][x], 0: in an object; coefficients are its neighbours'
  std::vector<glm::vec3> places;    ///< [z][y][x], world space: where it looks from
  /// [z][y][x][row][column], what it sees in the direction of an octahedral map's texel: the surface's unit
  /// normal n on its side and its distance h to the plane, m, so that n.(point - place) + h >= 0 in front of
  /// it. (0, 0, 0, 1) where nothing is near enough to hide points that the probe is asked about.
  std::vector<glm::vec4> surfaces;

  std::size_t columns() const { return static_cast<std::size_t>(order * order); }
};

/// Whether a point lies in front of all that a probe sees around its direction, in the four texels of a
/// bilinear look-up. Planes tell that next to walls, where distances by texel (as in dynamic diffuse global
/// illumination: Majercik, Guertin, Nowrouzezahrai and McGuire 2019) are a matter of the slant.
bool probeSees(const IrradianceVolume& volume, std::size_t probe, const glm::dvec3& point);

/// Irradiance, W/m2, of a point with a unit normal: of the eight probes around it, those that are valid and
/// see the point, or, where none does, those that are valid.
glm::dvec3 irradianceAt(const IrradianceVolume& volume, const glm::dvec3& point, const glm::dvec3& normal);

/// Irradiance of a probe alone.
glm::dvec3 probeIrradiance(const IrradianceVolume& volume, std::size_t probe, const glm::dvec3& normal);

}  // namespace prelight
