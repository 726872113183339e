#include "viewer/debug/debug_colors.h"

#include <algorithm>
#include <cmath>

namespace prelight::viewer {
namespace {

constexpr double goldenShare = 0.6180339887498949;  ///< (sqrt(5) - 1) / 2

/// Channels of a hue in turns, 0 (red) to 1, at full value.
glm::vec3 colorOfHue(double hue, float saturation) {
  glm::vec3 color;
  for (int c = 0; c < 3; ++c) {
    const double turn = std::abs(std::remainder(hue - c / 3.0, 1.0));
    color[c] = static_cast<float>(std::clamp(2.0 - 6.0 * turn, 0.0, 1.0));
  }
  return glm::vec3(1.0f - saturation) + saturation * color;
}

}  // namespace

glm::vec3 distinctColor(std::size_t number) {
  const double hue = std::fmod(goldenShare * static_cast<double>(number), 1.0);
  const float value = number % 2 == 0 ? 0.75f : 0.45f;
  return value * colorOfHue(hue, 0.85f);
}

glm::vec3 scaleColor(double share) {
  return 0.75f * colorOfHue(2.0 / 3.0 * (1.0 - std::clamp(share, 0.0, 1.0)), 0.95f);
}

}  // namespace prelight::viewer
