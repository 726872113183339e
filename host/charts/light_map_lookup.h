#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>

#include "prelight/light_map.h"

namespace prelight {

/// The texels that a bilinear look-up meets, and their weights, which sum to 1. Those without weight may be
/// any texel of the map. Texels beyond a wall have none.
struct LightMapLookUp {
  std::array<std::uint32_t, 4> texels{};
  std::array<double, 4> weights{};
};

/// Where a point of a face lies in the map, texels; barycentric weights of vertices 1 and 2.
glm::dvec2 lightMapPlace(const LightMapLayout& layout, std::uint32_t face, double b1, double b2);

/// Texels that a face covers.
double texelsOf(const LightMapLayout& layout, std::uint32_t face);

/// At a place in texels. `wide`: which answer, where walls leave two (charts/walled_square.h).
LightMapLookUp lookUp(const LightMapLayout& layout, const glm::dvec2& place, bool wide = false);

/// At a place in texels, with the darker of the two answers.
LightMapLookUp lookUp(const LightMap& map, const glm::dvec2& place);

/// A coefficient of the light map there, of each channel.
glm::dvec3 lightMapValue(const LightMap& map, const LightMapLookUp& at, int coefficient = 0);

/// Irradiance at a point of a face with a chart, W/m2: what pictures show, in double precision.
glm::dvec3 lightMapIrradiance(const LightMap& map, std::uint32_t face, double b1, double b2);

}  // namespace prelight
