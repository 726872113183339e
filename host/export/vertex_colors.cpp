#include "export/vertex_colors.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace prelight {

namespace {

/// The value that a hundredth of the colours lie above.
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

BakedColors bakedColors(const CompiledScene& scene, const Bake& bake, ExportForm form) {
  BakedColors result;
  const bool light = form == ExportForm::VertexLight;
  if (!light && form != ExportForm::VertexOcclusion) return result;
  if (light) result.scale = brightest(*bake.irradiance) / std::numbers::pi_v<float>;
  for (std::uint32_t v = 0; v < scene.vertexCount(); ++v) {
    const glm::vec3 baked =
        light ? (*bake.irradiance)[v] / (std::numbers::pi_v<float> * result.scale) : glm::vec3(bake.ao[v]);
    const glm::vec4 own = scene.hasVertexColors() ? scene.colors[v] : glm::vec4(1.0f);
    result.colors.push_back(glm::clamp(own * glm::vec4(baked, 1.0f), glm::vec4(0.0f), glm::vec4(1.0f)));
  }
  return result;
}

}  // namespace prelight
