#include "export/vertex_colors.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace prelight {

namespace {

/// Returns the value that a hundredth of the colours exceed.
float brightest(const std::vector<glm::vec3>& irradiance) {
  std::vector<float> values;
  values.reserve(irradiance.size());
  for (const glm::vec3& value : irradiance) values.push_back(std::max({value.x, value.y, value.z}));
  if (values.empty()) return 1.0f;
  const auto at = values.begin() + static_cast<std::ptrdiff_t>(0.99 * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), at, values.end());
  return *at > 0.0f ? *at : 1.0f;
}

}  // namespace

BakedColors::BakedColors(const CompiledScene& scene, const Bake& bake, ExportForm form)
    : scene_(scene), bake_(bake), form_(form) {
  if (form == ExportForm::VertexLight) scale_ = brightest(*bake.irradiance) / std::numbers::pi_v<float>;
}

std::vector<glm::vec4> BakedColors::of(const PrimitiveRange& range, const CompiledMaterial* lamp) const {
  std::vector<glm::vec4> colors;
  colors.reserve(range.vertexCount);
  for (std::uint32_t v = range.firstVertex; v < range.firstVertex + range.vertexCount; ++v) {
    glm::vec3 baked = form_ == ExportForm::VertexLight
                          ? (*bake_.irradiance)[v] / (std::numbers::pi_v<float> * scale_)
                          : glm::vec3(bake_.ao[v]);
    const glm::vec4 own = scene_.hasVertexColors() ? scene_.colors[v] : glm::vec4(1.0f);
    baked *= glm::vec3(own);
    if (lamp != nullptr) baked = baked * lamp->baseColor + lamp->emission / scale_;
    colors.push_back(glm::clamp(glm::vec4(baked, own.a), glm::vec4(0.0f), glm::vec4(1.0f)));
  }
  return colors;
}

}  // namespace prelight
