#include "encodings/dominant_direction/dominant_direction.h"

#include <algorithm>
#include <cassert>

#include "encodings/direction_fit.h"
#include "encodings/shader_source.h"
#include "encodings/stored_colour.h"

namespace prelight {
namespace {

constexpr std::size_t residual = 2;  ///< colours that may be negative: the lamp makes up for it

void encodeDominantDirection(std::span<const float> incident, const glm::mat3& frame,
                             std::span<float> values) {
  assert(values.size() == 12);
  const auto functions = [](const glm::dvec3& n, const glm::dvec3& d) {
    return std::array<double, 3>{0.5 + 0.5 * n.z, 0.5 - 0.5 * n.z, std::max(glm::dot(n, d), 0.0)};
  };
  const DirectedFit<3> fit = fitDirection<3>(fitIrradiance(incident, frame),
                                             dominantDirection(incident, frame), functions, residual);
  storeDirection(fit.direction, frame, fit.colours[2], values);
  storeColours<3>(fit.colours, values.subspan(3));
}

glm::vec3 dominantDirectionIrradiance(std::span<const float> values, const glm::mat3& frame,
                                      const glm::vec3& normal) {
  assert(values.size() == 12);
  const float up = glm::dot(normal, frame[2]);
  const float lamp = std::max(glm::dot(normal, storedDirection(values, frame[2])), 0.0f);
  return glm::max((0.5f + 0.5f * up) * storedColour(values, 3) +
                      (0.5f - 0.5f * up) * storedColour(values, 6) + lamp * storedColour(values, 9),
                  glm::vec3(0.0f));
}

}  // namespace

Encoding dominantDirectionEncoding() {
  return {"dominant-direction",
          "a lamp in the dominant direction, and a hemisphere of what remains",
          12,
          false,
          encodeDominantDirection,
          dominantDirectionIrradiance,
          encodingShader("dominant_direction")};
}

}  // namespace prelight
