#include "viewer/lights/illumination.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "basis/sh.h"

namespace prelight::viewer {
namespace {

void addDelta(const ShadedLight& light, int order, bool windowed, std::vector<double>& basis,
              std::vector<glm::dvec3>& sum) {
  sh::evaluate(-glm::normalize(glm::dvec3(light.direction)), order, basis);
  for (int l = 0; l < order; ++l) {
    const double window = windowed ? deltaWindow(l, order) : 1.0;
    for (int i = l * l; i < (l + 1) * (l + 1); ++i) sum[i] += window * basis[i] * glm::dvec3(light.intensity);
  }
}

}  // namespace

std::vector<glm::dvec3> farCoefficients(const Illumination& light, int order) {
  std::vector<glm::dvec3> sum = light.sky->turned(light.skyRotation, order);
  std::vector<double> basis(sum.size());
  for (const ShadedLight& source : light.lights)
    if (source.kind == LightKind::Directional) addDelta(source, order, light.windowLights, basis, sum);
  return sum;
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
