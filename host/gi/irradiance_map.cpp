#include "gi/irradiance_map.h"

#include "device/packed_arrays.h"

namespace prelight {

namespace {

std::vector<glm::vec2> markedCorners(const LightMapLayout& layout) {
  std::vector<glm::vec2> corners = layout.corners;
  for (std::size_t face = 0; face < layout.chartOf.size(); ++face)
    if (layout.chartOf[face] == LightMapLayout::noChart)
      for (std::size_t k = 0; k < 3; ++k) corners[3 * face + k] = glm::vec2(-1.0f);
  return corners;
}

}  // namespace

IrradianceMap::IrradianceMap(DeviceContext& device, const LightMapLayout& layout) {
  PackedArrays<device::IrradianceLine> pack;
  layout_.corners = pack.add(markedCorners(layout));
  layout_.texels = pack.reserve<glm::vec4>(layout.texelCount());
  layout_.width = static_cast<std::uint32_t>(layout.width);
  layout_.height = static_cast<std::uint32_t>(layout.height);
  layout_.triangleCount = static_cast<std::uint32_t>(layout.chartOf.size() / 2);
  lines_ = pack.upload(device);
}

void IrradianceMap::set(std::span<const glm::vec3> irradiance) {
  std::vector<glm::vec4> texels;
  texels.reserve(irradiance.size());
  for (const glm::vec3& e : irradiance) texels.emplace_back(e, 0.0f);
  lines_.writeArray(std::span<const glm::vec4>(texels), layout_.texels);
}

}  // namespace prelight
