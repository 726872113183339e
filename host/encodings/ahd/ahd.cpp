#include "encodings/encodings.h"

#include <algorithm>
#include <cassert>

#include "encodings/direction_fit.h"
#include "encodings/encoding.h"

namespace prelight {
namespace {

void encodeAhd(std::span<const float> incident, const glm::mat3& frame, std::span<float> values) {
  assert(values.size() == 9);
  const auto functions = [](const glm::dvec3& n, const glm::dvec3& d) {
    return std::array<double, 2>{1.0, std::max(glm::dot(n, d), 0.0)};
  };
  const DirectedFit<2> fit =
      fitDirection<2>(fitIrradiance(incident, frame), dominantDirection(incident, frame), functions, 0);
  storeDirection(fit.direction, frame, fit.colours[1], values);
  storeColours<2>(fit.colours, values.subspan(3));
}

glm::vec3 ahdIrradiance(std::span<const float> values, const glm::mat3& frame, const glm::vec3& normal) {
  assert(values.size() == 9);
  const float cosine = std::max(glm::dot(normal, storedDirection(values, frame[2])), 0.0f);
  return glm::max(storedColour(values, 3) + cosine * storedColour(values, 6), glm::vec3(0.0f));
}

}  // namespace

Encoding ahdEncoding() {
  return {
      "ahd", "ambient, highlight and direction", 9, false, encodeAhd, ahdIrradiance, encodingShader("ahd")};
}

}  // namespace prelight
