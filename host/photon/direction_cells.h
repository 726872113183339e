#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "prelight/compiled_scene.h"

/// Projection maps: the directions from a light in which objects may be hit (Jensen 2001, section 5.3).
namespace prelight {

struct Ball {
  glm::dvec3 centre{0.0};
  double radius = 0.0;
};

/// Returns a ball around the bounds of at least one triangle.
Ball ballAround(const CompiledScene& scene, std::span<const std::uint32_t> triangles);

/// Returns at most a few hundred balls that together contain the triangles.
std::vector<Ball> clusterBalls(const CompiledScene& scene, std::vector<std::uint32_t> triangles);

struct DirectionFrame {
  glm::dvec3 axis;
  glm::dvec3 tangent;
};

DirectionFrame frameAlong(const glm::dvec3& axis);

/// Maps a point (u, v) of the square to a direction: u is the turn around the axis, and v gives the cosine
/// with the axis, 1 - (1 - least) v for a cap, or the root of 1 - v for a cosine-weighted hemisphere. Equal
/// areas of the square emit equal power.
struct DirectionMap {
  enum Kind : std::uint8_t { Cap, Hemisphere } kind = Cap;
  double least = -1.0;  ///< cosine at the cap's rim
};

glm::dvec3 directionOf(const DirectionFrame& frame, const DirectionMap& map, double u, double v);

/// Returns the cells (row * side + column) of the square with a direction, in one of the frames, from a point
/// in `from` that may meet a ball of `targets`. The choice is conservative: no such direction is left out.
std::vector<std::uint32_t> cellsTowards(const Ball& from, std::span<const DirectionFrame> frames,
                                        const DirectionMap& map, std::span<const Ball> targets,
                                        std::uint32_t side);

}  // namespace prelight
