#include "fit/adaptive_smoothing.h"

#include <algorithm>

#include "fit/vertex_fit.h"

namespace prelight {

namespace {

// Variance of a value minus the mean of its six neighbours, over the variance of the value.
constexpr double noiseOfLaplacian = 1.2;
constexpr double gain = 0.8;          // best strength where curvature and noise are equal
constexpr double leastSignal = 0.02;  // least curvature to assume, relative to the noise

}  // namespace

std::vector<double> stiffnessOf(const FitMesh& mesh, std::span<const double> laplacian,
                                std::span<const double> standardError) {
  std::vector<double> stiffness(mesh.slotCount(), 1.0);
  for (std::uint32_t s = 0; s < mesh.slotCount(); ++s) {
    // The mean over the neighbours is used, whose curvature is similar: a single value is too often small by
    // chance.
    double bending = laplacian[s] * laplacian[s], variance = standardError[s] * standardError[s];
    for (std::uint32_t e = mesh.rowStart[s]; e < mesh.rowStart[s + 1]; ++e) {
      const std::uint32_t n = mesh.columns[e];
      bending += laplacian[n] * laplacian[n];
      variance += standardError[n] * standardError[n];
    }
    const double noise = noiseOfLaplacian * variance;
    const double signal = std::max(bending - noise, leastSignal * noise);
    if (noise > 0.0)
      stiffness[s] = std::clamp(gain * noise / (defaultSmoothing * signal), 1.0, mostStiffness);
  }
  return stiffness;
}

}  // namespace prelight
