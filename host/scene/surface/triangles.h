#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <optional>

#include "prelight/compiled_scene.h"

namespace prelight {

/// Returns twice the signed area of the triangle that `a` and `b` span with the origin.
inline double cross(const glm::dvec2& a, const glm::dvec2& b) { return a.x * b.y - a.y * b.x; }

/// Returns the barycentric weights of corners 1 and 2 for the point of a triangle's plane that is nearest to
/// `point`, also outside the triangle; 1/3 each where the triangle has no area.
inline glm::dvec2 triangleWeights(const CompiledScene& scene, std::uint32_t triangle,
                                  const glm::dvec3& point) {
  const glm::uvec3& t = scene.triangles[triangle];
  const glm::dvec3 a(scene.positions[t.x]), e = glm::dvec3(scene.positions[t.y]) - a,
                                            f = glm::dvec3(scene.positions[t.z]) - a;
  const glm::dvec3 n = glm::cross(e, f), p = point - a;
  const double squared = glm::dot(n, n);
  if (!(squared > 0.0)) return glm::dvec2(1.0 / 3.0);
  return {glm::dot(glm::cross(p, f), n) / squared, glm::dot(glm::cross(e, p), n) / squared};
}

/// Returns how far along a ray, in lengths of `direction`, it meets a triangle from either side; negative
/// behind its start (Moeller and Trumbore 1997, in double precision). For a few rays against all triangles,
/// without a tree.
std::optional<double> distanceTo(const CompiledScene& scene, std::uint32_t triangle, const glm::dvec3& from,
                                 const glm::dvec3& direction);

}  // namespace prelight
