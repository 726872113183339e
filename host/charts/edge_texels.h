#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "prelight/light_map.h"

namespace prelight {

/// Light of a light map's texels, [texel of the layout], irradiance summed over the channels.
struct TexelLight {
  std::span<const float> sharp;          ///< light of lights whose shadows have sharp edges
  std::span<const float> all;            ///< light of all lights
  std::span<const std::uint8_t> hidden;  ///< 1 inside an object, where the light does not count
};

/// Returns the texels that an edge of sharp light crosses, ascending: those whose sharp light differs from
/// that of one of the eight texels around by more than a small share of all light there. Texels of other
/// charts are not compared.
std::vector<std::uint32_t> edgeTexels(const LightMapLayout& layout, const TexelLight& light);

}  // namespace prelight
