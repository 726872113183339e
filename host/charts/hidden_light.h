#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <span>

#include "prelight/light_map.h"

namespace prelight {

/// Gives hidden texels the light of the darkest of their neighbours that are not, ring by ring within their
/// chart: a wall has rooms on both sides. A chart that is hidden as a whole stays as it is. values: [texel of
/// the layout][length], of which the first of each third is red, green and blue; hidden: [texel of the
/// layout].
void fillHidden(const LightMapLayout& layout, std::size_t length, std::span<const std::uint8_t> hidden,
                std::span<float> values);

/// As above, of a light map's texels.
void fillHidden(std::span<const std::uint8_t> hidden, LightMap& map);

/// Gives texels of a light map of one coefficient that have no light at all that of the darkest neighbours
/// that have some, ring by ring within their chart and not past walls: what lies below an object that moves.
void fillBlack(LightMap& map);

/// Sets the values of a light map of one coefficient from those of its texels, [texel of the layout]. Texels
/// that its walls say lie inside objects take after their neighbours.
void setIrradiance(std::span<const glm::vec3> irradiance, LightMap& map);

/// Luminance of the first of each third of some values.
double lightOf(std::span<const float> values);

}  // namespace prelight
