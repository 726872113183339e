#include "gi/irradiance_map.h"

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

IrradianceMap::IrradianceMap(DeviceContext& device, const LightMapLayout& layout)
    : width_(layout.width),
      height_(layout.height),
      corners_(device, std::span<const glm::vec2>(markedCorners(layout))),
      texels_(device, layout.texelCount()) {}

void IrradianceMap::set(std::span<const glm::vec3> irradiance) {
  std::vector<glm::vec4> texels;
  texels.reserve(irradiance.size());
  for (const glm::vec3& e : irradiance) texels.emplace_back(e, 0.0f);
  texels_.write(std::span<const glm::vec4>(texels));
}

cl_uint IrradianceMap::setArguments(cl::Kernel& kernel, cl_uint index) const {
  kernel.setArg(index, corners_.get());
  kernel.setArg(index + 1, texels_.get());
  return index + 2;
}

}  // namespace prelight
