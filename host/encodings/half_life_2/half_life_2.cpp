#include "encodings/encodings.h"

#include <algorithm>
#include <cassert>

#include "encodings/encoding.h"
#include "encodings/least_squares.h"

namespace prelight {
namespace {

/// Returns the weights of the vectors for a normal relative to the frame. Normals below the surface may have
/// all vectors behind them; their weights are 0.
std::array<float, 3> halfLife2Weights(const glm::vec3& n) {
  constexpr float a = 0.816496581f, b = 0.408248290f, c = 0.707106781f, z = 0.577350269f;
  std::array<float, 3> found = {std::max(a * n.x + z * n.z, 0.0f),
                                std::max(-b * n.x + c * n.y + z * n.z, 0.0f),
                                std::max(-b * n.x - c * n.y + z * n.z, 0.0f)};
  for (float& weight : found) weight *= weight;
  const float sum = std::max(found[0] + found[1] + found[2], 1e-6f);
  for (float& weight : found) weight /= sum;
  return found;
}

void encodeHalfLife2(std::span<const float> incident, const glm::mat3& frame, std::span<float> values) {
  assert(values.size() == 9);
  static const LinearFit<3> fit(fitFunctions<3>(halfLife2Weights));
  storeColours<3>(fit.colours(fitIrradiance(incident, frame)), values);
}

glm::vec3 halfLife2Irradiance(std::span<const float> values, const glm::mat3& frame,
                              const glm::vec3& normal) {
  assert(values.size() == 9);
  const std::array<float, 3> weight = halfLife2Weights(normal * frame);
  return glm::max(weight[0] * storedColour(values, 0) + weight[1] * storedColour(values, 3) +
                      weight[2] * storedColour(values, 6),
                  glm::vec3(0.0f));
}

}  // namespace

Encoding halfLife2Encoding() {
  return {"half-life-2",
          "three colours along the vectors of radiosity normal mapping",
          9,
          true,
          encodeHalfLife2,
          halfLife2Irradiance,
          encodingShader("half_life_2")};
}

}  // namespace prelight
