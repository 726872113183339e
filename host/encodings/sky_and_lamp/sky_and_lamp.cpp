#include "encodings/encodings.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "encodings/encoding.h"

namespace prelight {
namespace {

constexpr std::size_t terms = 4;
constexpr float constant = 0.282094792f;  // sqrt(1 / 4pi)
constexpr float linear = 0.488602512f;    // sqrt(3 / 4pi)

void encodeSkyAndLamp(std::span<const float> incident, const glm::mat3& /*frame*/, std::span<float> values) {
  assert(incident.size() == 3 * incidentTerms && values.size() == 3 * terms);
  for (std::size_t i = 0; i < terms; ++i)
    for (std::size_t channel = 0; channel < 3; ++channel)
      values[3 * i + channel] = incident[channel * incidentTerms + i];
}

/// Returns the irradiance a of the sky, which solves |V - a n| = F - 2 a, where F is the integral of
/// radiance, V that of radiance times direction, and `own` the component of V along the normal.
float skyIrradiance(float all, float own, float squaredVector) {
  const float vector = std::sqrt(squaredVector);
  const float sum = std::max(all, vector);
  const float b = 2.0f * sum - own;
  const float root = b * b - 3.0f * (sum - vector) * (sum + vector);
  return std::clamp((b - std::sqrt(std::max(root, 0.0f))) / 3.0f, 0.0f, std::max(own, 0.0f));
}

glm::vec3 skyAndLampIrradiance(std::span<const float> values, const glm::mat3& frame,
                               const glm::vec3& normal) {
  assert(values.size() == 3 * terms);
  const glm::vec3 n = frame[2];
  const float cosine = glm::dot(normal, n);
  glm::vec3 result(0.0f);
  for (int channel = 0; channel < 3; ++channel) {
    const auto term = [&](std::size_t i) { return values[3 * i + static_cast<std::size_t>(channel)]; };
    const glm::vec3 vector = glm::vec3(term(3), term(1), term(2)) / linear;
    const float sky = skyIrradiance(term(0) / constant, glm::dot(vector, n), glm::dot(vector, vector));
    const float lamp = glm::dot(vector - sky * n, normal);
    result[channel] = std::max(0.5f * sky * (1.0f + cosine), 0.0f) + std::max(lamp, 0.0f);
  }
  return result;
}

}  // namespace

Encoding skyAndLampEncoding() {
  return {"sky-and-lamp",
          "even sky and a lamp per channel, from spherical harmonics of order 2",
          3 * terms,
          false,
          encodeSkyAndLamp,
          skyAndLampIrradiance,
          encodingShader("sky_and_lamp")};
}

}  // namespace prelight
