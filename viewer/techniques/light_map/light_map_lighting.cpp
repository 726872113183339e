#include "viewer/techniques/light_map/light_map_lighting.h"

#include <algorithm>
#include <string>
#include <vector>

#include "prelight/error.h"
#include "techniques/light_map/light_map.h"
#include "viewer/programs/drawn_shading.h"
#include "viewer/programs/surface_uniforms.h"

namespace prelight::viewer {
namespace {

/// A coefficient, of a square of `side` texels; black outside the map, so that look-ups with no weight there
/// stay finite.
std::vector<glm::vec3> layerOf(std::span<const float> values, int width, int coefficients, int side,
                               int coefficient) {
  const auto length = static_cast<std::size_t>(coefficients), row = static_cast<std::size_t>(side),
             columns = static_cast<std::size_t>(width);
  std::vector<glm::vec3> layer(row * row, glm::vec3(0.0f));
  for (std::size_t texel = 0; 3 * length * texel < values.size(); ++texel) {
    const float* value = &values[3 * length * texel + static_cast<std::size_t>(coefficient)];
    layer[texel / columns * row + texel % columns] = {value[0], value[length], value[2 * length]};
  }
  return layer;
}

}  // namespace

std::vector<glm::vec2> lightMapCorners(const LightMapLayout& layout) {
  std::vector<glm::vec2> corners = layout.corners;
  for (std::size_t face = 0; face < layout.chartOf.size(); ++face)
    if (layout.chartOf[face] == LightMapLayout::noChart) corners[3 * face] = glm::vec2(-1.0f);
  return corners;
}

std::vector<glm::vec2> lightMapWalls(const LightMapLayout& layout, int width) {
  if (layout.walls.empty()) return {};
  const auto columns = static_cast<std::size_t>(layout.width), row = static_cast<std::size_t>(width);
  std::vector<glm::vec2> walls(row * static_cast<std::size_t>(layout.height),
                               glm::vec2(LightMapLayout::noWall));
  for (std::size_t texel = 0; texel < layout.walls.size(); ++texel)
    walls[texel / columns * row + texel % columns] = {layout.walls[texel].right, layout.walls[texel].below};
  return walls;
}

namespace {

/// One that is never read where the layout has none.
std::vector<glm::vec2> uploadedWalls(const LightMapLayout& layout) {
  std::vector<glm::vec2> walls = lightMapWalls(layout, std::max(layout.width, layout.height));
  if (walls.empty()) walls.emplace_back(LightMapLayout::noWall);
  return walls;
}

}  // namespace

LightMapLighting::LightMapLighting(const LightMap& map, const CompiledScene& scene)
    : frontFaces_(static_cast<int>(scene.triangleCount())),
      width_(map.layout.width),
      height_(map.layout.height),
      coefficients_(map.coefficients),
      walled_(!map.layout.walls.empty()),
      corners_(gl::makeBufferTexture(std::span<const glm::vec2>(lightMapCorners(map.layout)), 1, GL_RG32F,
                                     "light map coordinates")),
      walls_(gl::makeBufferTexture(std::span<const glm::vec2>(uploadedWalls(map.layout)), 1, GL_RG32F,
                                   "walls of the light map")),
      layers_(
          gl::makeFloatArray(std::max(map.layout.width, map.layout.height), map.coefficients, "light map")) {
  fill(map.values);
}

void LightMapLighting::fill(std::span<const float> values) {
  const std::size_t expected = 3 * static_cast<std::size_t>(coefficients_) *
                               static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_);
  if (values.size() != expected)
    throw Error(ExitCode::RuntimeFailure, "light map",
                std::to_string(values.size()) + " values, its layout needs " + std::to_string(expected));
  const int side = std::max(width_, height_);
  for (int layer = 0; layer < coefficients_; ++layer)
    gl::fillFloatArray(layers_, {0, 0, layer}, {side, side},
                       layerOf(values, width_, coefficients_, side, layer));
}

void LightMapLighting::bind(const gl::Program& program) const {
  setUnknownAccessibility();
  program.set("frontFaces", frontFaces_);
  program.set("lightMapWalled", walled_);
  gl::bind(lightMapCornersUnit, GL_TEXTURE_BUFFER, corners_.texture);
  gl::bind(lightMapWallsUnit, GL_TEXTURE_BUFFER, walls_.texture);
  gl::bind(lightMapsUnit, GL_TEXTURE_2D_ARRAY, layers_);
}

void LightMapLighting::describe(const Illumination&, Warnings&) const {}

extern const DrawnShading drawnLightMap = {
    .info = &lightMapShading,
    .make = [](const TechniqueInputs& of) -> std::unique_ptr<DrawnTransfer> {
      return std::make_unique<LightMapLighting>(*of.inputs.bake->lightMap, of.inputs.compiled);
    },
};

}  // namespace prelight::viewer
