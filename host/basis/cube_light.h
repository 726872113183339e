#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "basis/cube_map.h"

namespace prelight {

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
