#pragma once

#include <array>
#include <vector>

#include "basis/cube_map.h"
#include "prelight/picture.h"

namespace prelight {

/// A sky as programs look it up that have no time to gather its light.
struct PrefilteredSky {
  std::array<glm::dvec3, 9> irradiance{};  ///< SH of order 3 of irradiance by the normal, W/m2
  std::vector<CubeMap> levels;             ///< mean radiance, each half the size; see roughness()

  /// Of a level: 0 for the first, 1 for the last one, evenly.
  double roughness(std::size_t level) const;
};

/// Levels down to 16 texels a side. Each but the first is the mean of the sky over what a surface of a
/// roughness reflects of it that is seen along its normal: weighed by n.l and the distribution of microfacets
/// (GGX, alpha = roughness^2), as Karis (2013, Real Shading in Unreal Engine 4) splits the sum.
PrefilteredSky prefilterSky(const Environment& sky);

/// One of the levels: the mean of a map over the lobe about the middle of every texel of a size.
CubeMap prefilterCube(const CubeMap& map, double roughness, int faceSize);

}  // namespace prelight
