#pragma once

#include <cstdint>

#include "prelight/compiled_scene.h"
#include "scene/surface_regions.h"

namespace prelight {

/// Fewest texels of a light map whose texel size or number is not specified: a room of 35 m2 gets texels of
/// 2.3 cm.
constexpr std::uint32_t fewestUsualTexels = std::uint32_t{1} << 16;
constexpr std::uint32_t mostUsualTexels = std::uint32_t{1} << 20;

/// The texels of a scene's light map if neither size nor number is specified.
struct UsualTexels {
  std::uint32_t count = fewestUsualTexels;  ///< approximate
  double area = 0.0;                        ///< lit area, of both sides where both are lit, m2
};

/// Chooses the number of texels: few blur the light of small pieces of surface, many take long. Light is
/// assumed to vary over each piece about equally, whatever its size, so that the squared error of a piece is
/// 1 / its number of texels, at most 1. The sum of the mean error over the area and a price per texel is
/// minimised. Where no piece is smaller than a texel, the count grows with the root of the number of pieces.
/// `regions`: of the scene, by the usual crease angle.
UsualTexels usualTexels(const CompiledScene& scene, const SurfaceRegions& regions);
UsualTexels usualTexels(const CompiledScene& scene);

}  // namespace prelight
