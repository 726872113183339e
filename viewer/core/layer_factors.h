#pragma once

#include <array>
#include <cstddef>

#include "images/picture_parts.h"

namespace prelight::viewer {

/// A layer of a drawn picture: the number of a PicturePart, or how open surfaces are.
using DrawnLayer = int;
constexpr DrawnLayer accessibilityLayer = static_cast<DrawnLayer>(pictureParts);

/// Factors of the layers of a picture, >= 0, as `partFactors` of shaders/parts.glsl. That of accessibility is
/// 0, or 1 where it is shown in place of light.
using LayerFactors = std::array<float, pictureParts + 1>;

constexpr LayerFactors wholePicture = {1.0f, 1.0f, 1.0f, 1.0f, 1.0f, 1.0f, 0.0f};

constexpr float factorOf(const LayerFactors& factors, PicturePart part) {
  return factors[static_cast<std::size_t>(part)];
}

/// The factors by which one layer is drawn alone, of a picture that has these.
constexpr LayerFactors alone(DrawnLayer layer, const LayerFactors& of) {
  LayerFactors factors{};
  const auto i = static_cast<std::size_t>(layer);
  factors[i] = layer == accessibilityLayer ? 1.0f : of[i];
  return factors;
}

}  // namespace prelight::viewer
