#include "encodings/encodings.h"

#include <cassert>

#include "encodings/encoding.h"
#include "encodings/least_squares.h"

namespace prelight {
namespace {

std::array<float, 2> hemisphereShares(float cosine) { return {0.5f + 0.5f * cosine, 0.5f - 0.5f * cosine}; }

void encodeHemisphere(std::span<const float> incident, const glm::mat3& frame, std::span<float> values) {
  assert(values.size() == 6);
  static const LinearFit<2> fit(fitFunctions<2>([](const glm::vec3& n) { return hemisphereShares(n.z); }));
  storeColours<2>(fit.colours(fitIrradiance(incident, frame)), values);
}

glm::vec3 hemisphereIrradiance(std::span<const float> values, const glm::mat3& frame,
                               const glm::vec3& normal) {
  assert(values.size() == 6);
  const auto [above, below] = hemisphereShares(glm::dot(normal, frame[2]));
  return glm::max(above * storedColour(values, 0) + below * storedColour(values, 3), glm::vec3(0.0f));
}

}  // namespace

Encoding hemisphereEncoding() {
  return {"hemisphere",
          "two colours over the surface's normal",
          6,
          false,
          encodeHemisphere,
          hemisphereIrradiance,
          encodingShader("hemisphere")};
}

}  // namespace prelight
