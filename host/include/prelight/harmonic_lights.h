#pragma once

#include <cstddef>
#include <glm/glm.hpp>
#include <span>
#include <vector>

/// Lights in SH, and directional lights that stand for radiance in SH. The functions shOf...() return the
/// coefficients, order^2, of the radiance that arrives at a point from a light of 1 in its unit, in closed
/// form or by integrals over its outline. Positions are relative to the point, in metres; directions have any
/// length but 0. All throw UsageError for an order outside 1 to 32, and for lights that are not finite or
/// touch the point.
namespace prelight {

/// A light in one direction, of 1 W/m2 on a surface that faces it.
std::vector<double> shOfDirection(const glm::dvec3& towards, int order);

/// A point light of 1 W/sr.
std::vector<double> shOfPoint(const glm::dvec3& position, int order);

/// Radiance 1 from all directions within `halfAngle`, 0 to pi radians, of a direction: the sun, or a disk
/// that faces the point.
std::vector<double> shOfCap(const glm::dvec3& towards, double halfAngle, int order);

/// A sphere of radiance 1. For a point inside it, radiance comes from everywhere.
std::vector<double> shOfSphere(const glm::dvec3& centre, double radius, int order);

/// A flat round disk of radiance 1 that shines to both sides; 0 within its plane.
std::vector<double> shOfDisk(const glm::dvec3& centre, const glm::dvec3& normal, double radius, int order);

/// A polygon of radiance 1 that shines to both sides, of less than 2 pi sr. At least three vertices, in order
/// in either sense, need not lie in a plane; edges are great arcs. The outline must not cross itself.
std::vector<double> shOfPolygon(std::span<const glm::dvec3> vertices, int order);

/// A light in one direction that stands for a part of the radiance.
struct DominantLight {
  glm::dvec3 towards{0.0, 0.0, 1.0};  ///< unit
  glm::dvec3 irradiance{0.0};         ///< W/m2 on a surface that faces it, >= 0
};

/// Directional lights, and the radiance that they leave.
struct DominantLights {
  std::vector<DominantLight> lights;  ///< by descending luminance
  std::vector<double> residual;       ///< [channel][i]
};

/// Returns at most `most` >= 1 directional lights that leave the least luminance in the residual of radiance,
/// [channel][i], 3 x order^2, order >= 2; fewer where another would not help.
DominantLights dominantLights(std::span<const double> radiance, int order, std::size_t most = 1);

}  // namespace prelight
