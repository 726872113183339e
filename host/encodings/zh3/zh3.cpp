#include "encodings/encodings.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <string>

#include "base/colour.h"
#include "encodings/encoding.h"
#include "encodings/least_squares.h"

namespace prelight {
namespace {

constexpr std::size_t linearTerms = 4;

void storeLinear(std::span<const float> incident, std::span<float> values) {
  for (std::size_t i = 0; i < linearTerms; ++i)
    for (std::size_t channel = 0; channel < 3; ++channel)
      values[3 * i + channel] = incident[channel * incidentTerms + i];
}

/// Returns the axis of the linear band's luminance, or the surface's normal if that is 0.
glm::vec3 axisOf(std::span<const float> values, const glm::vec3& normal) {
  const auto bright = [&](std::size_t i) {
    return 0.2126f * values[3 * i] + 0.7152f * values[3 * i + 1] + 0.0722f * values[3 * i + 2];
  };
  const glm::vec3 linear(bright(3), bright(1), bright(2));
  const float largest = std::max(std::abs(linear.x), std::max(std::abs(linear.y), std::abs(linear.z)));
  return largest > 0.0f ? glm::normalize(linear / largest) : normal;
}

glm::vec3 linearIrradiance(std::span<const float> values, const glm::vec3& n) {
  // pi sqrt(1 / 4pi), 2 pi / 3 sqrt(3 / 4pi)
  return 0.886226925f * storedColour(values, 0) +
         1.023326708f *
             (n.y * storedColour(values, 3) + n.z * storedColour(values, 6) + n.x * storedColour(values, 9));
}

/// Returns the irradiance of the quadratic zonal harmonic: pi / 4 sqrt(5 / 16pi) (3 cos^2 - 1).
float zonalIrradiance(float cosine) { return 0.247707956f * (3.0f * cosine * cosine - 1.0f); }

/// Stores the linear bands and the zonal coefficient with the least squared error of irradiance over the fit
/// normals; without the coefficient the encoding would be SH of order 2.
void encodeZh3(std::span<const float> incident, const glm::mat3& frame, std::span<float> values) {
  assert(incident.size() == 3 * incidentTerms && values.size() == 15);
  storeLinear(incident, values);
  const glm::vec3 axis = axisOf(values, frame[2]);
  const FitIrradiance wanted = fitIrradiance(incident, frame);
  glm::dvec3 product(0.0);
  double square = 0.0;
  for (std::size_t i = 0; i < fitNormalCount; ++i) {
    const glm::vec3 normal = frame * glm::vec3(fitNormals()[i].direction);
    const double zonal = zonalIrradiance(glm::dot(axis, normal)), weight = fitNormals()[i].weight;
    product += weight * zonal * (wanted[i] - glm::dvec3(linearIrradiance(values, normal)));
    square += weight * zonal * zonal;
  }
  for (int channel = 0; channel < 3; ++channel)
    values[12 + static_cast<std::size_t>(channel)] = static_cast<float>(product[channel] / square);
}

glm::vec3 zh3Irradiance(std::span<const float> values, const glm::mat3& frame, const glm::vec3& normal) {
  assert(values.size() == 15);
  const float zonal = zonalIrradiance(glm::dot(axisOf(values, frame[2]), normal));
  return glm::max(linearIrradiance(values, normal) + zonal * storedColour(values, 12), glm::vec3(0.0f));
}

void encodeHallucinated(std::span<const float> incident, const glm::mat3& /*frame*/,
                        std::span<float> values) {
  assert(incident.size() == 3 * incidentTerms && values.size() == 12);
  storeLinear(incident, values);
}

glm::vec3 hallucinatedIrradiance(std::span<const float> values, const glm::mat3& frame,
                                 const glm::vec3& normal) {
  assert(values.size() == 12);
  const glm::vec3 axis = axisOf(values, frame[2]), all = storedColour(values, 0);
  const glm::vec3 along = glm::abs(axis.y * storedColour(values, 3) + axis.z * storedColour(values, 6) +
                                   axis.x * storedColour(values, 9));
  glm::vec3 coefficient(0.0f);
  for (int channel = 0; channel < 3; ++channel)
    if (all[channel] > 0.0f)
      coefficient[channel] = along[channel] * (0.08f + 0.6f * (along[channel] / all[channel]));
  return glm::max(linearIrradiance(values, normal) + zonalIrradiance(glm::dot(axis, normal)) * coefficient,
                  glm::vec3(0.0f));
}

std::string zh3Shader(bool hallucinated) {
  return std::string("const bool encodedHallucination = ") + (hallucinated ? "true" : "false") + ";\n" +
         std::string(encodingShader("zh3"));
}

}  // namespace

Encoding zh3Encoding() {
  static const std::string shader = zh3Shader(false);
  return {
      "zh3", "spherical harmonics of order 2 and a quadratic zonal one", 15, false, encodeZh3, zh3Irradiance,
      shader};
}

Encoding zh3HallucinatedEncoding() {
  static const std::string shader = zh3Shader(true);
  return {"zh3-hallucinated",
          "spherical harmonics of order 2, and a quadratic zonal one guessed from them",
          12,
          false,
          encodeHallucinated,
          hallucinatedIrradiance,
          shader};
}

}  // namespace prelight
