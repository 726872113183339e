#include "viewer/light_map_lighting.h"

#include <algorithm>
#include <vector>

namespace prelight::viewer {
namespace {

/// [face][3] texels from the upper left; far to the left where there is no chart.
std::vector<glm::vec2> cornersOf(const LightMapLayout& layout) {
  std::vector<glm::vec2> corners = layout.corners;
  for (std::size_t face = 0; face < layout.chartOf.size(); ++face)
    if (layout.chartOf[face] == LightMapLayout::noChart) corners[3 * face] = glm::vec2(-1.0f);
  return corners;
}

/// Of a square of `side` texels; black outside the map, so that look-ups with no weight there stay finite.
std::vector<glm::vec3> irradianceOf(const LightMap& map, int side) {
  const auto length = static_cast<std::size_t>(map.coefficients), row = static_cast<std::size_t>(side),
             width = static_cast<std::size_t>(map.layout.width);
  std::vector<glm::vec3> irradiance(row * row, glm::vec3(0.0f));
  for (std::size_t texel = 0; texel < map.layout.texelCount(); ++texel) {
    const float* values = &map.values[3 * length * texel];
    irradiance[texel / width * row + texel % width] = {values[0], values[length], values[2 * length]};
  }
  return irradiance;
}

}  // namespace

LightMapLighting::LightMapLighting(const LightMap& map, const CompiledScene& scene)
    : frontFaces_(static_cast<int>(scene.triangleCount())),
      corners_(gl::makeBufferTexture(std::span<const glm::vec2>(cornersOf(map.layout)), 1, GL_RG32F,
                                     "light map coordinates")),
      irradiance_(gl::makeFloatArray(std::max(map.layout.width, map.layout.height), 1, "light map")) {
  const int side = std::max(map.layout.width, map.layout.height);
  gl::fillFloatArray(irradiance_, {0, 0, 0}, {side, side}, irradianceOf(map, side));
}

void LightMapLighting::bind(const gl::Program& program) const {
  program.set("transferForm", static_cast<int>(TransferForm::None));
  program.set("frontFaces", frontFaces_);
  gl::bind(lightMapCornersUnit, GL_TEXTURE_BUFFER, corners_.texture);
  gl::bind(lightMapsUnit, GL_TEXTURE_2D_ARRAY, irradiance_);
}

void LightMapLighting::describe(const Illumination&, Warnings&) const {}

}  // namespace prelight::viewer
