#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "viewer/core/render_options.h"

namespace prelight::viewer {

/// Zonal coefficients of lobes by roughness.
struct LobeTable {
  int order = 0;
  /// [step][band], roughness = step / (lobeSteps - 1). x: factor of a band of what arrives, so that the sum
  /// over coefficients B_lm of x_l Y_lm(axis) B_lm is the integral of lobe times what arrives; y: x times the
  /// factor of P_l(normal . axis) in what arrives at an open surface under an even sky.
  std::vector<glm::vec2> bands;
  /// [step], the share of a lobe that is reflected through its bands, 0..1. The rest is too narrow for them
  /// and reflects the sky itself.
  std::vector<float> shares;

  /// Returns what shaders read: [step][band], and after the bands of each step its share as y.
  std::vector<glm::vec2> texels() const;
};

constexpr int lobeSteps = 65;

LobeTable makeLobeTable(Lobe lobe, int order);

/// Phong exponent that stands for a roughness of glTF.
double phongExponent(double roughness);

}  // namespace prelight::viewer
