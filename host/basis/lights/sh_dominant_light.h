#pragma once

#include <glm/glm.hpp>
#include <optional>
#include <span>
#include <vector>

namespace prelight::sh {

/// A directional light, and the rest of the radiance from which it was extracted.
struct DominantLight {
  glm::dvec3 towards{0.0, 0.0, 1.0};  ///< unit direction of the light
  glm::dvec3 irradiance{0.0};         ///< W/m2 on a surface that faces it, >= 0
  std::vector<double> residual;       ///< [channel][i], the radiance without the light
};

/// Extracts a directional light from radiance [channel R, G, B][i], 3 x order^2 entries, order >= 2: its
/// direction is that of the luminance's linear band, its intensity minimises the squared residual per
/// channel. Returns none when the linear band is 0. Throws UsageError for a bad order and for coefficients
/// that are too few or not finite.
std::optional<DominantLight> dominantLight(std::span<const double> radiance, int order);

/// Several directional lights, and the rest of the radiance.
struct DominantLights {
  struct Light {
    glm::dvec3 towards{0.0, 0.0, 1.0};
    glm::dvec3 irradiance{0.0};
  };
  std::vector<Light> lights;     ///< by descending luminance
  std::vector<double> residual;  ///< [channel][i]
};

/// Extracts up to `most` directional lights from radiance as above. Each new one is placed where it reduces
/// the luminance's squared residual most; then all are turned, one after the other, to where they do so among
/// the others. Their intensities are found together, by non-negative least squares per channel. Returns fewer
/// where no further light would reduce the residual. Throws as dominantLight() does.
DominantLights dominantLights(std::span<const double> radiance, int order, std::size_t most);

}  // namespace prelight::sh
