#pragma once

#include <span>
#include <vector>

#include "prelight/bake.h"

namespace prelight {

/// Error of a compression. Sums over vertices are weighted; with surfaceOfVertices() as weights, "RMS" is
/// over the surface.
struct CompressionError {
  double squared = 0.0;           ///< total weighted squared error of the vectors
  double vectorRms = 0.0;         ///< relative to the RMS of the vectors
  double lightingRms = 0.0;       ///< relative error of the radiance before albedo, over all of testLights()
  double worstLightingRms = 0.0;  ///< relative error for the light with the greatest error
};

/// Returns coefficients of a few test lights, [light][channel][i]: an even sky, a brighter zenith and two
/// suns of different colours. A sun is a single direction, the hardest possible light.
std::vector<std::vector<double>> testLights(int order);

/// Compares two transfers. Empty weights count all vertices alike. Throws UsageError when the shapes differ.
CompressionError compressionError(const HarmonicTransfer& original, const HarmonicTransfer& restored,
                                  std::span<const double> vertexWeights = {});

/// Returns the radiance before albedo, in double precision, [vertex]. `light` is [channel][i].
std::vector<glm::dvec3> relight(const HarmonicTransfer& transfer, std::span<const double> light);

}  // namespace prelight
