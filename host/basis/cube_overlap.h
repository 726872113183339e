#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

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

}  // namespace prelight
