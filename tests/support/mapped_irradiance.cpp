#include "support/mapped_irradiance.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace prelight {

glm::dvec3 mappedIrradiance(const MapLight& light, const glm::dvec3& normal, const glm::dvec3& mapped) {
  static const double constant = std::sqrt(1.0 / (4.0 * std::numbers::pi)),
                      linear = std::sqrt(3.0 / (4.0 * std::numbers::pi));
  glm::dvec3 result(0.0);
  for (int c = 0; c < 3; ++c) {
    const double irradiance = light[0][c];
    glm::dvec3 vector(light[4][c] / linear, light[2][c] / linear, light[3][c] / linear);
    // Makes V.n equal E, which would differ between texels.
    vector += (irradiance - glm::dot(vector, normal)) * normal;
    const double length = glm::length(vector);
    const double all = std::max(light[1][c] / constant, length);
    const double b = 2.0 * all - irradiance;
    const double root = std::sqrt(std::max(b * b - 3.0 * (all * all - length * length), 0.0));
    const double even = std::clamp((b - root) / 3.0, 0.0, std::max(irradiance, 0.0));
    result[c] = 0.5 * even * (1.0 + glm::dot(mapped, normal)) +
                std::max(glm::dot(vector - even * normal, mapped), 0.0);
  }
  return result;
}

MapLight incidentLight(const LightMap& map, const LightMapLookUp& at) {
  MapLight light;
  for (int i = 0; i < 5; ++i) light[static_cast<std::size_t>(i)] = lightMapValue(map, at, i);
  return light;
}

}  // namespace prelight
