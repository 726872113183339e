#pragma once

#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "viewer/core/render_options.h"
#include "viewer/lights/lighting.h"

namespace prelight::viewer {

/// The light of a view. Transfer is lit anew when this differs from the last one. Referents outlive it.
struct Illumination {
  const SkyCoefficients* sky = nullptr;
  const Environment* skyMap = nullptr;  ///< what `sky` was made from; nullptr: no sky
  double skyRotation = 0.0;             ///< radians about +Y
  std::vector<ShadedLight> lights;
  std::size_t haarTerms = 0;     ///< coefficients that a wavelet light keeps; 0: all
  double horizonSoftness = 0.0;  ///< angular radius of lamps without a size, above horizons, radians
  OccluderOptions occluders;
  OccluderEye eye;  ///< where the camera stands, for transfers that depend on it; else as it is here
  std::vector<glm::vec3> groupFactors;  ///< [light group]; fewer: the others are 1

  bool operator==(const Illumination&) const = default;
};

/// SH coefficients of the sky of an illumination, turned: [i] RGB, order^2.
std::vector<glm::dvec3> skyCoefficients(const Illumination& light, int order);

/// Returns the sky's coefficients, smoothed until the sky is negative nowhere.
std::vector<glm::dvec3> smoothedCoefficients(const Illumination& light, int order);

/// Returns coefficients in the order [channel][i], 3 x order^2.
std::vector<double> byChannel(std::span<const glm::dvec3> coefficients);

/// The sky turned counter-clockwise about +Y by `angle`: columns move, and share their light where they do
/// not move by whole texels, so that every row keeps its energy.
Environment turnedSky(const Environment& sky, double angle);

}  // namespace prelight::viewer
