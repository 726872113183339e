#pragma once

#include <cstdint>

#include "prelight/compiled_scene.h"
#include "scene/surface_regions.h"

namespace prelight {

/// The fewest texels that a light map has where nobody asks for their size or number: a room of 35 m2 gets
/// texels of 2.3 cm.
constexpr std::uint32_t fewestUsualTexels = std::uint32_t{1} << 16;
constexpr std::uint32_t mostUsualTexels = std::uint32_t{1} << 20;

/// What a scene's light map takes, where nobody asks for a size or a number of texels.
struct UsualTexels {
  std::uint32_t count = fewestUsualTexels;  ///< about
  double area = 0.0;                        ///< lit, both sides where both are, m2
};

/// Few texels blur the light of small pieces of surface, and many take long. Light is taken to change over a
/// piece about as much as over any other, whatever their sizes, so that the squared error of a piece is one
/// over its texels, 1 at most. Its mean over the area and a price for each texel together are the least.
/// Where no piece is smaller than a texel, the count grows with the root of the number of pieces. `regions`:
/// of the scene, by the usual crease angle.
UsualTexels usualTexels(const CompiledScene& scene, const SurfaceRegions& regions);
UsualTexels usualTexels(const CompiledScene& scene);

}  // namespace prelight
