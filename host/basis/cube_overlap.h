#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "basis/cube_map.h"

namespace prelight {

/// A part of a texel of a cube map.
struct TexelOverlap {
  std::uint32_t texel = 0;
  double solidAngle = 0.0;  ///< sr, > 0
};

/// Appends the solid angles that a convex spherical polygon shares with the texels of a cube map, exact up to
/// rounding. `corners` are directions of any length but 0, at most 128, in either sense of rotation, and lie
/// in an open hemisphere; the edges are arcs of great circles.
void overlapTexels(std::span<const glm::dvec3> corners, int faceSize, std::vector<TexelOverlap>& overlaps);

/// Returns the four corners of a texel, in order around it, as directions that are not normalised.
std::array<glm::dvec3, 4> texelCorners(std::uint32_t texel, int faceSize);

/// A linear map from the texels of a cube map to those of a rotated one, as sparse rows.
struct CubeResampling {
  int faceSize = 0;
  std::vector<std::uint32_t> offsets;  ///< [texel of the result], then the end
  std::vector<std::uint32_t> sources;  ///< source texels of each result
  std::vector<float> weights;          ///< [source] weights, whose sum per row is 1

  CubeMap apply(const CubeMap& map) const;
};

/// Returns the map to the rotated function f'(w) = f(R^-1 w) as means over texels: weights are the exact
/// overlaps with the rotated texels. Preserves flux. `rotation` is orthonormal.
CubeResampling rotateByArea(const glm::dmat3& rotation, int faceSize);

/// Returns a black cube map.
CubeMap darkCube(int faceSize);

/// Adds a distant disk of uniform radiance: a cap of `halfAngle` (rad, in (0, pi/2)) around the unit
/// direction `toLight`. Texels get their share by the exact overlap with a polygon of 128 corners and the
/// same solid angle, whose rim is within 2e-4 radii of the circle. Throws UsageError for other angles,
/// InputError for radiance that is negative or not finite.
void addDisk(CubeMap& map, const glm::dvec3& toLight, double halfAngle, const glm::vec3& radiance);

/// Adds a directional light with `irradiance` (W/m2) on a surface that faces it. It is spread over a disk of
/// about a texel, so that the lighting changes smoothly as it moves. Throws as addDisk() does.
void addDirectional(CubeMap& map, const glm::dvec3& toLight, const glm::vec3& irradiance);

/// Adds a map of the same size.
void addCube(CubeMap& map, const CubeMap& other);

}  // namespace prelight
