#pragma once

#include <glm/glm.hpp>
#include <vector>

namespace prelight::viewer {

/// The shape of glossy reflection in glossy shading, about the mirrored view.
enum class Lobe {
  /// The microfacet reflection at normal incidence as a function of the angle to the mirrored direction,
  /// whatever the view, and as much of it as the split-sum reflectance of the view says: an open surface
  /// under an even sky reflects just that. A lobe sharper than the order can show is smoothed until, cut off
  /// there, it is nowhere negative: it would show rings in place of a reflection.
  Ggx,
  /// The modified Phong BRDF, F0 (n + 2) / (2 pi) cos^n, with n = 2 / roughness^4 - 2: exact but for the
  /// bands that are cut, however sharp it is.
  Phong,
};

/// Zonal coefficients of lobes by roughness.
struct LobeTable {
  int order = 0;
  /// [step][band], roughness = step / (lobeSteps - 1). x: factor of a band of what arrives, so that the sum
  /// over coefficients B_lm of x_l Y_lm(axis) B_lm is the integral of lobe times what arrives; y: x times the
  /// factor of P_l(normal . axis) in what arrives at an open surface under an even sky.
  std::vector<glm::vec2> bands;
};

constexpr int lobeSteps = 65;

LobeTable makeLobeTable(Lobe lobe, int order);

/// Phong exponent that stands for a roughness of glTF.
double phongExponent(double roughness);

}  // namespace prelight::viewer
