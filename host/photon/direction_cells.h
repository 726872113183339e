#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "prelight/compiled_scene.h"

/// Projection maps: which directions from a light may meet something (Jensen 2001, section 5.3).
namespace prelight {

struct Ball {
  glm::dvec3 centre{0.0};
  double radius = 0.0;
};

/// Around the bounds of triangles; at least one.
Ball ballAround(const CompiledScene& scene, std::span<const std::uint32_t> triangles);

/// Balls that hold the triangles together, a few hundred at most.
std::vector<Ball> clusterBalls(const CompiledScene& scene, std::vector<std::uint32_t> triangles);

struct DirectionFrame {
  glm::dvec3 axis;
  glm::dvec3 tangent;
};

DirectionFrame frameAlong(const glm::dvec3& axis);

/// How a point (u, v) of the square becomes a direction: u turns around the axis, and v gives the cosine with
/// it, 1 - (1 - least) v over a cap, or the root of 1 - v over a cosine-weighted hemisphere. Equal areas of
/// the square send equal power.
struct DirectionMap {
  enum Kind : std::uint8_t { Cap, Hemisphere } kind = Cap;
  double least = -1.0;  ///< cosine at the cap's rim
};

glm::dvec3 directionOf(const DirectionFrame& frame, const DirectionMap& map, double u, double v);

/// Cells (row * side + column) of the square, of which some direction may meet a ball of `targets` from a
/// point of `from` in one of the frames. Conservative: no direction that does is left out.
std::vector<std::uint32_t> cellsTowards(const Ball& from, std::span<const DirectionFrame> frames,
                                        const DirectionMap& map, std::span<const Ball> targets,
                                        std::uint32_t side);

}  // namespace prelight
