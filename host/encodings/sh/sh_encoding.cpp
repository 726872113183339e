#include "encodings/encodings.h"

#include <cassert>
#include <string>

#include "encodings/encoding.h"

namespace prelight {
namespace {

template <std::size_t terms>
void encodeSh(std::span<const float> incident, const glm::mat3& /*frame*/, std::span<float> values) {
  assert(incident.size() == 3 * incidentTerms && values.size() == 3 * terms);
  for (std::size_t i = 0; i < terms; ++i)
    for (std::size_t channel = 0; channel < 3; ++channel)
      values[3 * i + channel] = incident[channel * incidentTerms + i];
}

template <std::size_t terms>
glm::vec3 shIrradiance(std::span<const float> values, const glm::mat3& /*frame*/, const glm::vec3& n) {
  assert(values.size() == 3 * terms);
  const auto colour = [&](std::size_t i) {
    return glm::vec3(values[3 * i], values[3 * i + 1], values[3 * i + 2]);
  };
  // pi sqrt(1 / 4pi), 2 pi / 3 sqrt(3 / 4pi)
  glm::vec3 sum =
      0.886226925f * colour(0) + 1.023326708f * (n.y * colour(1) + n.z * colour(2) + n.x * colour(3));
  if constexpr (terms == 9) {
    // pi / 4 times sqrt(15 / 4pi), sqrt(5 / 16pi), sqrt(15 / 16pi)
    sum += 0.858085531f * (n.x * n.y * colour(4) + n.y * n.z * colour(5) + n.x * n.z * colour(7)) +
           0.247707956f * (3.0f * n.z * n.z - 1.0f) * colour(6) +
           0.429042765f * (n.x * n.x - n.y * n.y) * colour(8);
  }
  return glm::max(sum, glm::vec3(0.0f));
}

std::string shShader(int order) {
  return "const int encodedOrder = " + std::to_string(order) + ";\n" + std::string(encodingShader("sh"));
}

}  // namespace

Encoding shEncoding(int order) {
  assert(order == 2 || order == 3);
  if (order == 2) {
    static const std::string shader = shShader(2);
    return {"sh-2", "spherical harmonics of order 2", 12, false, encodeSh<4>, shIrradiance<4>, shader};
  }
  static const std::string shader = shShader(3);
  return {"sh-3", "spherical harmonics of order 3", 27, false, encodeSh<9>, shIrradiance<9>, shader};
}

}  // namespace prelight
