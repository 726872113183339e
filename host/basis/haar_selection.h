#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "basis/cube_map.h"

/// Which Haar coefficients are kept: of transfer when it is stored, and of the light when it is used.
namespace prelight::haar {

/// Coefficients that are kept, ascending by index.
struct SparseRow {
  std::vector<std::uint32_t> indices;
  std::vector<float> values;
};

/// The fewest coefficients, largest first, whose relative L2 error is at most `relativeError` in [0, 1]: the
/// square root of the sum of squares that is dropped over the whole. 0 keeps all that are not 0. Linear time.
SparseRow keepError(std::span<const float> coefficients, double relativeError);

/// The `count` coefficients with the greatest |coefficient| x weight, of which none is 0; of equals the one
/// with the lower index. `weights` is empty for 1 everywhere.
SparseRow keepLargest(std::span<const float> coefficients, std::size_t count,
                      std::span<const float> weights = {});

/// The integral of every wavelet's magnitude over its support, in sr: with these weights selection is
/// area-weighted (Ng et al. 2003). A transfer coefficient is at most this over pi. [6 S^2]
std::vector<float> areaWeights(int faceSize);

/// Coefficients of a cube map's radiance, [channel][i]. Throws as checkCubeMap() does.
std::vector<float> transformLight(const CubeMap& map);

/// Coefficients of a light that are used, shared by its channels, ascending by index.
struct SparseLight {
  std::vector<std::uint32_t> indices;
  std::vector<glm::vec3> values;
};

/// Importance of the light's coefficients: the root of the sum over channels of squares, times the weight.
/// With coefficientRms() of a transfer as weights it is what a coefficient adds to the lit result, in RMS.
/// [i]
std::vector<float> lightMagnitudes(std::span<const float> light, std::span<const float> weights);

/// The `count` most important coefficients as they are (Ng et al. 2003; Kautz 2004).
SparseLight selectLight(std::span<const float> light, std::span<const float> weights, std::size_t count);

/// As selectLight(), but coefficients fade in as they grow past the greatest magnitude t that is left out: a
/// factor (1 - t/m) fade / (fade - 1) for magnitudes m up to fade x t, 1 beyond; fade > 1. The result is a
/// continuous function of the light.
SparseLight selectLightSoftly(std::span<const float> light, std::span<const float> weights, std::size_t count,
                              float fade);

/// Keeps a selection steady while a light changes from frame to frame: a coefficient that is in stays in
/// until its magnitude falls below 1 / (1 + hysteresis) of one that is out, and comes and goes over `frames`
/// frames. Values are always those of the present light.
class SteadySelection {
 public:
  SteadySelection(std::size_t count, float hysteresis, int frames)
      : count_(count), hysteresis_(hysteresis), step_(1.0f / static_cast<float>(frames)) {}

  /// The next frame's light. The first call selects at once. Returns at least `count` coefficients and those
  /// that are on their way out.
  SparseLight next(std::span<const float> light, std::span<const float> weights);

 private:
  std::size_t count_;
  float hysteresis_;
  float step_;
  std::vector<float> presence_;  ///< [i], 0 out to 1 in
  std::vector<bool> chosen_;
};

/// The relative RMS error to be expected of results lit by a part of the light, if transfer coefficients were
/// uncorrelated: the root of the sum of squared magnitudes of light - part over that of the light.
double expectedError(std::span<const float> light, const SparseLight& part, std::span<const float> weights);

}  // namespace prelight::haar
