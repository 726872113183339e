#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "gpu/tracer.h"
#include "prelight/compiled_scene.h"
#include "prelight/light_map.h"

namespace prelight {

/// Indices of two places.
using PlacePair = std::array<std::uint32_t, 2>;

/// The obstacle between two places.
struct Obstacle {
  bool seen = true;            ///< there is none: the first place sees the second
  glm::dvec3 point{0.0};       ///< otherwise the point where the ray from the first meets it
  std::uint32_t triangle = 0;  ///< triangle at that point
};

/// Returns [pair] whether neighbouring places see each other along the surface. One ray joins the two just
/// above the surface, and another one a little higher, so that a wall that hovers by less counts. Triangles
/// of the two places' charts are ignored, because the way across a curved surface dips below it, and so are
/// those for which `ignored`, [triangle] or empty, is 1. The tracer must be that of the scene.
std::vector<Obstacle> lookAlong(const CompiledScene& scene, Tracer& tracer, const LightMapLayout& layout,
                                std::span<const LightMapTexel> places, std::span<const PlacePair> pairs,
                                std::span<const std::uint8_t> ignored = {});

/// Finds surfaces that stand on or cross the surfaces of a layout between neighbouring texels, such as the
/// wall between two rooms that share a floor, and which texels beside them lie inside objects: sets the
/// layout's `walls`, and `whole` of its texels. Costs about four short rays per texel. `ignored`: [triangle]
/// 1 where a triangle is no wall, because it will move; empty: all may be walls. The tracer must be that of
/// the scene.
void findWalls(const CompiledScene& scene, Tracer& tracer, LightMapLayout& layout,
               std::span<const std::uint8_t> ignored = {});

/// Returns [texel of the layout] the number of the patch on which it lies. Texels of a chart that are
/// connected by steps between neighbours without walls form a patch, whose number is the index of its first
/// texel.
std::vector<std::uint32_t> wallPatches(const LightMapLayout& layout);

}  // namespace prelight
