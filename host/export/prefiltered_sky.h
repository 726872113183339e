#pragma once

#include <array>
#include <vector>

#include "basis/cube_map.h"
#include "prelight/picture.h"

namespace prelight {

/// A sky that is integrated in advance for programs that render in real time.
struct PrefilteredSky {
  std::array<glm::dvec3, 9> irradiance{};  ///< SH of order 3 of irradiance by normal, W/m2
  /// Mean radiance, each level half as large as the previous one; see roughness().
  std::vector<CubeMap> levels;

  /// Returns the roughness of a level: evenly spaced from 0 for the first to 1 for the last.
  double roughness(std::size_t level) const;
};

/// Prefilters a sky to levels down to faces of 16 texels. Each level but the first is the mean of the sky
/// over the lobe of its roughness (basis/sky_lobes.h).
PrefilteredSky prefilterSky(const Environment& sky);

}  // namespace prelight
