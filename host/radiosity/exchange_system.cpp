#include "radiosity/exchange_system.h"

#include <algorithm>

#include "base/span_of.h"

namespace prelight {

namespace {

std::vector<glm::vec4> padded(const std::vector<glm::vec3>& colors) {
  std::vector<glm::vec4> values;
  for (const glm::vec3& color : colors) values.emplace_back(color, 0.0f);
  return values;
}

}  // namespace

std::vector<glm::vec4> transmissionOfElements(const CompiledScene& scene, const RadiosityElements& elements,
                                              std::uint32_t count) {
  std::vector<glm::vec4> values(count, glm::vec4(0.0f));
  for (std::uint32_t t = 0; t < scene.triangleCount(); ++t) {
    const glm::vec4 through(scene.materials[scene.triangleMaterials[t]].diffuseTransmission, 0.0f);
    for (std::uint32_t side = 0; side < count / elements.perSide(); ++side)
      std::fill(values.begin() + side * elements.perSide() + elements.first[t],
                values.begin() + side * elements.perSide() + elements.first[t + 1], through);
  }
  return values;
}

ExchangeSystem::ExchangeSystem(DeviceContext& device, const CompiledScene& scene,
                               const RadiosityElements& elements, const FormFactors& factors)
    : device_(device),
      size_(factors.elementCount()),
      perSide_(elements.perSide()),
      rowStart_(device, spanOf(factors.rowStart)),
      columns_(device, spanOf(factors.columns)),
      values_(device, spanOf(factors.values)),
      scale_(device, spanOf(factors.scale)),
      areas_(device, spanOf(factors.areas)),
      albedo_(device, spanOf(padded(factors.albedo))) {
  const bool translucent = scene.hasDiffuseTransmission() && factors.backs;
  const std::vector<glm::vec4> through =
      translucent ? transmissionOfElements(scene, elements, size_) : std::vector<glm::vec4>();
  transmission_ = Buffer<glm::vec4>(device, spanOf(through));
  for (std::uint32_t i = 0; i < size_; ++i)
    for (int c = 0; c < 3; ++c)
      greatestAlbedo_ =
          std::max(greatestAlbedo_, double(factors.albedo[i][c]) + (translucent ? through[i][c] : 0.0f));
  options_.defineIf(translucent, "PRELIGHT_TRANSLUCENT");
}

}  // namespace prelight
