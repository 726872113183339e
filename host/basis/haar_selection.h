#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "basis/cube_map.h"

/// Selection of Haar coefficients: of transfer when it is stored, and of the light when it is used.
namespace prelight::haar {

/// The kept coefficients of a row, ascending by index.
struct SparseRow {
  std::vector<std::uint32_t> indices;
  std::vector<float> values;
};

/// Returns the fewest coefficients, largest first, whose relative L2 error is at most `relativeError` in [0,
/// 1]: the square root of the ratio of the dropped sum of squares to the total. 0 keeps all nonzero
/// coefficients. Takes linear time.
SparseRow keepError(std::span<const float> coefficients, double relativeError);

/// Returns the `count` coefficients with the greatest |coefficient| x weight, none of which is 0; among
/// equals the one with the lower index. `weights` is empty for 1 everywhere.
SparseRow keepLargest(std::span<const float> coefficients, std::size_t count,
                      std::span<const float> weights = {});

/// Returns the integral of every wavelet's magnitude over its support, in sr: with these weights selection is
/// area-weighted (Ng et al. 2003). A transfer coefficient is at most this divided by pi. [6 S^2]
std::vector<float> areaWeights(int faceSize);

/// Returns the coefficients of a cube map's radiance, [channel][i]. Throws as checkCubeMap() does.
std::vector<float> transformLight(const CubeMap& map);

/// The selected coefficients of a light, shared by its channels, ascending by index.
struct SparseLight {
  std::vector<std::uint32_t> indices;
  std::vector<glm::vec3> values;
};

/// A selected coefficient of a light.
struct LitWavelet {
  std::uint32_t index = 0;  ///< below 6 faceSize^2
  glm::vec3 color{0.0f};
};

/// Returns [i] the importance of the light's coefficients: the root of the sum over channels of squares,
/// times the weight. With coefficientRms() of a transfer as weights it is the RMS contribution of a
/// coefficient to the lit result.
std::vector<float> lightMagnitudes(std::span<const float> light, std::span<const float> weights);

/// Returns the `count` most important coefficients unchanged (Ng et al. 2003; Kautz 2004).
SparseLight selectLight(std::span<const float> light, std::span<const float> weights, std::size_t count);

/// Returns the coefficients of selectLight(), faded in as they exceed the greatest magnitude t that is left
/// out: they are multiplied by (1 - t/m) fade / (fade - 1) for magnitudes m up to fade x t, and by 1 beyond;
/// fade > 1. The result is a continuous function of the light.
SparseLight selectLightSoftly(std::span<const float> light, std::span<const float> weights, std::size_t count,
                              float fade);

/// Keeps a selection steady while a light changes from frame to frame: a selected coefficient stays selected
/// until its magnitude falls below 1 / (1 + hysteresis) of one that is not, and coefficients fade in and out
/// over `frames` frames. Values are always those of the present light.
class SteadySelection {
 public:
  SteadySelection(std::size_t count, float hysteresis, int frames)
      : count_(count), hysteresis_(hysteresis), step_(1.0f / static_cast<float>(frames)) {}

  /// Returns the selection for the next frame's light: at least `count` coefficients, and those that are
  /// fading out. The first call selects without fading.
  SparseLight next(std::span<const float> light, std::span<const float> weights);

 private:
  std::size_t count_;
  float hysteresis_;
  float step_;
  std::vector<float> presence_;  ///< [i] from 0, out, to 1, in
  std::vector<bool> chosen_;
};

/// Returns the expected relative RMS error of results lit by a part of the light, assuming uncorrelated
/// transfer coefficients: the root of the sum of squared magnitudes of light - part, divided by that of the
/// light.
double expectedError(std::span<const float> light, const SparseLight& part, std::span<const float> weights);

}  // namespace prelight::haar
