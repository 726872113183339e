#include "encodings/encodings.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "encodings/direction_fit.h"
#include "encodings/encoding.h"

namespace prelight {
namespace {

template <typename Real>
std::array<Real, 3> trilightShares(Real cosine) {
  return {std::max(cosine, Real(0)), Real(1) - std::abs(cosine), std::max(-cosine, Real(0))};
}

void encodeTrilight(std::span<const float> incident, const glm::mat3& frame, std::span<float> values) {
  assert(values.size() == 12);
  const auto functions = [](const glm::dvec3& n, const glm::dvec3& d) {
    return trilightShares(glm::dot(n, d));
  };
  const DirectedFit<3> fit =
      fitDirection<3>(fitIrradiance(incident, frame), dominantDirection(incident, frame), functions, 0);
  storeDirection(fit.direction, frame, fit.colours[0], values);
  storeColours<3>(fit.colours, values.subspan(3));
}

glm::vec3 trilightIrradiance(std::span<const float> values, const glm::mat3& frame, const glm::vec3& normal) {
  assert(values.size() == 12);
  const auto share =
      trilightShares(std::clamp(glm::dot(normal, storedDirection(values, frame[2])), -1.0f, 1.0f));
  return glm::max(share[0] * storedColour(values, 3) + share[1] * storedColour(values, 6) +
                      share[2] * storedColour(values, 9),
                  glm::vec3(0.0f));
}

}  // namespace

Encoding trilightEncoding() {
  return {"trilight",
          "a direction, and three colours along, across and against it",
          12,
          false,
          encodeTrilight,
          trilightIrradiance,
          encodingShader("trilight")};
}

}  // namespace prelight
