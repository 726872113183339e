#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "prelight/light_map.h"

namespace prelight {

/// Light of a light map's texels, [texel of the layout], irradiance summed over the channels.
struct TexelLight {
  std::span<const float> sharp;          ///< of lights whose shadows have sharp edges
  std::span<const float> all;            ///< that and all other light
  std::span<const std::uint8_t> hidden;  ///< 1 inside an object: nothing that is seen there counts
};

/// Texels that an edge of sharp light crosses, ascending: from one of the eight texels around them it differs
/// by more than a small part of all light there. Texels that other surfaces part are left out.
std::vector<std::uint32_t> edgeTexels(const LightMapLayout& layout, const TexelLight& light);

}  // namespace prelight
