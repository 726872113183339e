#pragma once

#include <glm/glm.hpp>
#include <optional>
#include <span>
#include <vector>

namespace prelight::sh {

/// A directional light and what it leaves of the radiance that it was taken from.
struct DominantLight {
  glm::dvec3 towards{0.0, 0.0, 1.0};  ///< unit direction of the light
  glm::dvec3 irradiance{0.0};         ///< W/m2 on a surface that faces it, >= 0
  std::vector<double> residual;       ///< [channel][i], the radiance without the light
};

/// Takes a directional light from radiance [channel R, G, B][i], 3 x order^2 entries, order >= 2: its
/// direction is that of the luminance's linear band, its intensity the one that leaves the least squared
/// residual a channel. None when the linear band is 0. Throws UsageError for a bad order and coefficients
/// that are too few or not finite.
std::optional<DominantLight> dominantLight(std::span<const double> radiance, int order);

/// Several, and what all of them leave.
struct DominantLights {
  struct Light {
    glm::dvec3 towards{0.0, 0.0, 1.0};
    glm::dvec3 irradiance{0.0};
  };
  std::vector<Light> lights;     ///< from the brightest luminance on
  std::vector<double> residual;  ///< [channel][i]
};

/// Takes up to `most` directional lights from radiance as above. The next one stands where it lessens the
/// luminance's squared residual most; then all turn, one after the other, to where they do so among the
/// others. Their intensities are found together, by non-negative least squares a channel. Fewer where nothing
/// is left that a light could lessen. Throws as above.
DominantLights dominantLights(std::span<const double> radiance, int order, std::size_t most);

}  // namespace prelight::sh
