#include "encodings/encodings.h"

#include <cassert>
#include <string>

#include "encodings/encoding.h"
#include "encodings/least_squares.h"

namespace prelight {
namespace {

template <std::size_t count>
void encodeHBasis(std::span<const float> incident, const glm::mat3& frame, std::span<float> values) {
  assert(values.size() == 3 * count);
  static const LinearFit<count> fit(fitFunctions<count>(hBasis));
  storeColours<count>(fit.colours(fitIrradiance(incident, frame)), values);
}

template <std::size_t count>
glm::vec3 hBasisIrradiance(std::span<const float> values, const glm::mat3& frame, const glm::vec3& normal) {
  assert(values.size() == 3 * count);
  const std::array<float, 6> basis = hBasis(normal * frame);
  glm::vec3 sum(0.0f);
  for (std::size_t i = 0; i < count; ++i) sum += basis[i] * storedColour(values, 3 * i);
  return glm::max(sum, glm::vec3(0.0f));
}

std::string hBasisShader(int functions) {
  return "const int encodedFunctions = " + std::to_string(functions) + ";\n" +
         std::string(encodingShader("h_basis"));
}

}  // namespace

std::array<float, 6> hBasis(const glm::vec3& d) {
  constexpr float constant = 0.398942280f;  // sqrt(1 / 2pi)
  constexpr float linear = 0.690988299f;    // sqrt(3 / 2pi)
  constexpr float squared = 0.772548404f;   // sqrt(15 / 2pi) / 2
  return {constant,
          linear * d.y,
          linear * (2.0f * d.z - 1.0f),
          linear * d.x,
          2.0f * squared * d.x * d.y,
          squared * (d.x * d.x - d.y * d.y)};
}

Encoding hBasisEncoding(int functions) {
  assert(functions == 4 || functions == 6);
  if (functions == 4) {
    static const std::string shader = hBasisShader(4);
    return {"h-basis-4", "four functions of the H-basis", 12, true, encodeHBasis<4>, hBasisIrradiance<4>,
            shader};
  }
  static const std::string shader = hBasisShader(6);
  return {"h-basis-6", "six functions of the H-basis", 18, true, encodeHBasis<6>, hBasisIrradiance<6>,
          shader};
}

}  // namespace prelight
