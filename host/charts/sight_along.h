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

}  // namespace prelight
