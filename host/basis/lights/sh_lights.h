#pragma once

#include <glm/glm.hpp>
#include <span>

/// Coefficients of the light that arrives at a point, in closed form or by integrals over the light's
/// outline, for any order. Positions are relative to the point, in metres. `values` receives order^2
/// coefficients of radiance for a light of 1 in its unit (docs/conventions.md). All throw UsageError for a
/// bad order and for a light that is not finite or touches the point.
namespace prelight::sh {

/// Writes the coefficients of a directional light of 1 W/m2 from the unit direction `towards` it:
/// Y_i(towards).
void directionalLight(const glm::dvec3& towards, int order, std::span<double> values);

/// Writes those of a point light of 1 W/sr at `position`: Y_i / distance^2.
void pointLight(const glm::dvec3& position, int order, std::span<double> values);

/// Writes those of radiance 1 from all directions within `halfAngle` (radians, 0 to pi) of the unit direction
/// `towards`: the sun, or a disk that faces the point.
void capLight(const glm::dvec3& towards, double halfAngle, int order, std::span<double> values);

/// Writes those of a sphere of radiance 1. For a point inside it, radiance comes from everywhere.
void sphereLight(const glm::dvec3& centre, double radius, int order, std::span<double> values);

/// Writes those of a polygon of radiance 1 that shines to both sides: the region of the sphere inside the
/// outline, which is the smaller one, of less than 2 pi sr. The vertices, in order in either sense, need not
/// lie in a plane; edges are great arcs. At least 3 vertices; the outline must not cross itself.
void polygonLight(std::span<const glm::dvec3> vertices, int order, std::span<double> values);

/// Writes those of a flat round disk of radiance 1 that shines to both sides; 0 as seen from within its
/// plane. Also throws UsageError when the point lies so close to the rim that no rule of 65536 nodes
/// suffices.
void diskLight(const glm::dvec3& centre, const glm::dvec3& normal, double radius, int order,
               std::span<double> values);

}  // namespace prelight::sh
