#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "prelight/transfer.h"

namespace prelight {

/// Irradiance at points in the air due to the scene's own lights, for diffuse surfaces with any normal. Each
/// cell has a probe at its centre; if that lies in an object, the probe looks from a place nearby.
struct IrradianceVolume {
  /// Side of a probe's map of surfaces, texels.
  static constexpr int surfaceSide = 8;

  VolumeGrid grid;
  int order = 3;  ///< bands of SH, 1 to 3; higher bands hardly contribute to irradiance
  /// [z][y][x][i][channel], incident radiance, W/(m2 sr); the irradiance for a normal is sum pi
  /// clampedCosine(l) L_i Y_i(normal).
  std::vector<float> coefficients;
  std::vector<std::uint8_t> valid;  ///< [z][y][x], 0: inside an object; its coefficients come from neighbours
  std::vector<glm::vec3> places;    ///< [z][y][x], world space, where the probe looks from
  /// [z][y][x][row][column], the surface that a probe sees in the direction of a texel of an octahedral map:
  /// the unit normal n on the visible side and the distance h to the plane, m, so that n.(point - place) + h
  /// >= 0 in front of it. (0, 0, 0, 1) if no surface is near enough to hide points that the probe is used
  /// for.
  std::vector<glm::vec4> surfaces;

  std::size_t columns() const { return static_cast<std::size_t>(order * order); }
};

/// Returns whether a point lies in front of the surfaces that a probe sees around its direction, in the four
/// texels of a bilinear look-up. Planes decide this reliably next to walls, where the distances per texel of
/// dynamic diffuse global illumination (Majercik, Guertin, Nowrouzezahrai and McGuire 2019) vary with the
/// slant.
bool probeSees(const IrradianceVolume& volume, std::size_t probe, const glm::dvec3& point);

/// Returns the irradiance, W/m2, at a point with a unit normal, interpolated between those of the eight
/// surrounding probes that are valid and see the point, or, if none does, those that are valid.
glm::dvec3 irradianceAt(const IrradianceVolume& volume, const glm::dvec3& point, const glm::dvec3& normal);

/// Returns the irradiance of a single probe.
glm::dvec3 probeIrradiance(const IrradianceVolume& volume, std::size_t probe, const glm::dvec3& normal);

}  // namespace prelight
