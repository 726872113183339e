#pragma once

#include <span>
#include <vector>

#include "prelight/bake.h"

namespace prelight {

/// What compression changed. Sums over vertices are weighted, so that "RMS" is over the surface when the
/// weights are surfaceOfVertices().
struct CompressionError {
  double squared = 0.0;           ///< total weighted squared error of the vectors
  double vectorRms = 0.0;         ///< relative to the RMS of the vectors
  double lightingRms = 0.0;       ///< of radiance before albedo, relative, over all of testLights()
  double worstLightingRms = 0.0;  ///< of the light that suffers most
};

/// Coefficients of a few lights, [light][channel][i]: an even sky, a brighter zenith, two suns of different
/// colours. A sun is a direction, the hardest light that there is.
std::vector<std::vector<double>> testLights(int order);

/// Throws UsageError when the two differ in shape. Empty weights: all vertices alike.
CompressionError compressionError(const HarmonicTransfer& original, const HarmonicTransfer& restored,
                                  std::span<const double> vertexWeights = {});

/// Radiance before albedo in double: [vertex]. `light` is [channel][i].
std::vector<glm::dvec3> relight(const HarmonicTransfer& transfer, std::span<const double> light);

}  // namespace prelight
