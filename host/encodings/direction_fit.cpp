#include "encodings/direction_fit.h"

#include <algorithm>
#include <cassert>

#include "base/colour.h"
#include "encodings/encoding.h"

namespace prelight {

glm::dvec3 dominantDirection(std::span<const float> incident, const glm::mat3& frame) {
  assert(incident.size() == 3 * incidentTerms);
  const auto bright = [&](std::size_t i) {
    return luminance({incident[i], incident[incidentTerms + i], incident[2 * incidentTerms + i]});
  };
  const glm::dvec3 world = glm::dvec3(bright(3), bright(1), bright(2)) / std::sqrt(3.0);
  const glm::dvec3 vector = glm::transpose(glm::dmat3(frame)) * world;
  const double length = glm::length(vector), all = std::max(bright(0), length);
  // A vector within the rounding errors of the coefficients has no direction.
  constexpr double rounding = 1e-6;
  if (!(length > rounding * all)) return {0.0, 0.0, 1.0};
  const double b = 2.0 * all - vector.z;
  const double root = b * b - 3.0 * (all - length) * (all + length);
  const double sky = std::clamp((b - std::sqrt(std::max(root, 0.0))) / 3.0, 0.0, std::max(vector.z, 0.0));
  const glm::dvec3 lamp = vector - glm::dvec3(0.0, 0.0, sky);
  const double rest = glm::length(lamp);
  return rest > 1e-3 * length ? lamp / rest : glm::dvec3(0.0, 0.0, 1.0);
}

double squareOf(const FitIrradiance& irradiance) {
  double sum = 0.0;
  for (std::size_t n = 0; n < fitNormalCount; ++n)
    sum += fitNormals()[n].weight * glm::dot(irradiance[n], irradiance[n]);
  return sum;
}

glm::vec3 storedDirection(std::span<const float> values, const glm::vec3& normal) {
  const float largest = std::max(std::abs(values[0]), std::max(std::abs(values[1]), std::abs(values[2])));
  if (!(largest > 0.0f)) return normal;
  return glm::normalize(glm::vec3(values[0], values[1], values[2]) / largest);
}

void storeDirection(const glm::dvec3& direction, const glm::mat3& frame, const glm::dvec3& colour,
                    std::span<float> values) {
  const glm::dvec3 world = luminance(colour) * (glm::dmat3(frame) * direction);
  for (int axis = 0; axis < 3; ++axis)
    values[static_cast<std::size_t>(axis)] = static_cast<float>(world[axis]);
}

}  // namespace prelight
