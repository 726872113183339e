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

/// Two places, by their indices.
using PlacePair = std::array<std::uint32_t, 2>;

/// What stands between two places.
struct Obstacle {
  bool seen = true;            ///< nothing: the first place sees the second
  glm::dvec3 point{0.0};       ///< else where the way from the first meets it first
  std::uint32_t triangle = 0;  ///< that it meets there
};

/// Whether pairs of neighbouring places see each other along the surface: [pair]. A ray joins the two just
/// above the surface, and another one a little higher, so that a wall that hovers by less counts. Triangles
/// of the two places' charts hide nothing: the way across a curved surface dips below it. Neither do those of
/// `ignored`, [triangle], where it is not empty and 1. The scene is the one that the tracer was made of.
std::vector<Obstacle> lookAlong(const CompiledScene& scene, Tracer& tracer, const LightMapLayout& layout,
                                std::span<const LightMapTexel> places, std::span<const PlacePair> pairs,
                                std::span<const std::uint8_t> ignored = {});

}  // namespace prelight
