#include "viewer/lights/illumination.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace prelight::viewer {

std::vector<glm::dvec3> skyCoefficients(const Illumination& light, int order) {
  return light.sky->turned(light.skyRotation, order);
}

std::vector<glm::dvec3> smoothedCoefficients(const Illumination& light, int order) {
  std::vector<glm::dvec3> sky = skyCoefficients(light, order);
  const std::vector<double>& factors = light.sky->smoothing(order).factors;
  for (std::size_t l = 0; l < factors.size(); ++l)
    for (std::size_t i = l * l; i < (l + 1) * (l + 1); ++i) sky[i] *= factors[l];
  return sky;
}

std::vector<double> byChannel(std::span<const glm::dvec3> coefficients) {
  std::vector<double> channels(3 * coefficients.size());
  for (std::size_t c = 0; c < 3; ++c) {
    for (std::size_t i = 0; i < coefficients.size(); ++i)
      channels[c * coefficients.size() + i] = coefficients[i][static_cast<int>(c)];
  }
  return channels;
}

Environment turnedSky(const Environment& sky, double angle) {
  // u falls as the angle grows: a turn takes -Z, in the middle, to -X, on the left.
  const double shift = -angle / (2.0 * std::numbers::pi) * sky.width;
  const double whole = std::floor(shift);
  const auto part = static_cast<float>(shift - whole);
  const auto offset = static_cast<int>(whole);
  Environment turned = sky;
  const auto wrapped = [&](int column) { return ((column % sky.width) + sky.width) % sky.width; };
  for (int row = 0; row < sky.height; ++row) {
    const auto* from = sky.radiance.data() + static_cast<std::size_t>(row) * sky.width;
    auto* to = turned.radiance.data() + static_cast<std::size_t>(row) * sky.width;
    for (int column = 0; column < sky.width; ++column)
      to[column] = (1.0f - part) * from[wrapped(column - offset)] + part * from[wrapped(column - offset - 1)];
  }
  return turned;
}

}  // namespace prelight::viewer
