#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>

#include "prelight/light_map.h"

namespace prelight {

/// The square between texel (x, y) of a layout and those to the right, below and diagonally below: shares of
/// its edges at which walls cross them. kernels/shared/walled_square.h explains their meaning.
struct SquareWalls {
  float top = LightMapLayout::noWall;
  float bottom = LightMapLayout::noWall;
  float left = LightMapLayout::noWall;
  float right = LightMapLayout::noWall;

  bool any() const;
};

SquareWalls wallsOf(const LightMapLayout& layout, int x, int y);

/// Returns the weights of (x, y), (x + 1, y), (x, y + 1), (x + 1, y + 1) at a point of the square, at
/// `share`, 0 to 1, from the first: bilinear among those on the point's side of the walls. Walls that are
/// only partly known give two answers, of which `wide` selects the first; look-ups take the darker one.
std::array<double, 4> walledWeights(const SquareWalls& walls, const glm::dvec2& share, bool wide);

/// The texels that a bilinear look-up meets, and their weights, whose sum is 1. Texels of weight 0 may be any
/// texels of the map. Texels beyond a wall have weight 0.
struct LightMapLookUp {
  std::array<std::uint32_t, 4> texels{};
  std::array<double, 4> weights{};
};

/// Returns where a point of a face lies in the map, texels; b1, b2: barycentric weights of vertices 1 and 2.
glm::dvec2 lightMapPlace(const LightMapLayout& layout, std::uint32_t face, double b1, double b2);

/// Returns the number of texels that a face covers.
double texelsOf(const LightMapLayout& layout, std::uint32_t face);

/// Looks up a place, in texels. `wide`: selects the answer where walls leave two (charts/light_map_lookup.h).
LightMapLookUp lookUp(const LightMapLayout& layout, const glm::dvec2& place, bool wide = false);

/// Looks up a place, in texels, and returns the darker of the two answers.
LightMapLookUp lookUp(const LightMap& map, const glm::dvec2& place);

/// Returns a coefficient of the light map in a look-up, per channel.
glm::dvec3 lightMapValue(const LightMap& map, const LightMapLookUp& at, int coefficient = 0);

/// Returns the irradiance, W/m2, at a point of a face with a chart, as pictures show it but in double
/// precision.
glm::dvec3 lightMapIrradiance(const LightMap& map, std::uint32_t face, double b1, double b2);

}  // namespace prelight
