#include "viewer/techniques/series/chart_lighting.h"

#include <algorithm>
#include <array>

#include "base/parallel.h"

namespace prelight::viewer {
namespace {

/// Radiance of a map's texels before albedo, with the border around: [row][column].
std::vector<glm::vec3> lightThrough(const ChartTransfer& transfer, const ChartTransfer::Map& map,
                                    const std::vector<glm::vec3>& light) {
  const int width = map.width + 2 * chartBorder, height = map.height + 2 * chartBorder;
  std::vector<glm::vec3> radiance(static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
  const auto lightRow = [&](int row) {
    for (int column = 0; column < width; ++column) {
      const int x = std::clamp(column - chartBorder, 0, map.width - 1),
                y = std::clamp(row - chartBorder, 0, map.height - 1);
      const float* from =
          &map.coefficients[static_cast<std::size_t>(y * map.width + x) * transfer.rowLength()];
      glm::vec3 sum(0.0f);
      for (int c = 0; c < 3; ++c) {
        const float* channel =
            from + (transfer.channels == 3 ? static_cast<std::size_t>(c) * light.size() : 0);
        for (std::size_t i = 0; i < light.size(); ++i) sum[c] += light[i][c] * channel[i];
      }
      // A truncated series may dip below zero.
      radiance[static_cast<std::size_t>(row * width + column)] = glm::max(sum, glm::vec3(0.0f));
    }
  };
  parallelRanges(static_cast<std::size_t>(height), 8, [&](std::size_t begin, std::size_t end) {
    for (std::size_t row = begin; row < end; ++row) lightRow(static_cast<int>(row));
  });
  return radiance;
}

}  // namespace

ChartAtlas chartAtlasOf(const ChartTransfer& transfer) {
  std::vector<glm::ivec2> sizes;
  for (const auto& map : transfer.maps)
    sizes.emplace_back(map.width + 2 * chartBorder, map.height + 2 * chartBorder);
  return packCharts(sizes);
}

std::vector<glm::vec4> chartCoords(const ChartTransfer& transfer, const CompiledScene& scene,
                                   const ChartAtlas& atlas) {
  std::vector<glm::vec4> coords(scene.vertexCount(), glm::vec4(0.0f));
  for (std::size_t m = 0; m < transfer.maps.size(); ++m) {
    const auto& map = transfer.maps[m];
    const ChartAtlas::Place& place = atlas.places[m];
    const glm::vec2 corner(place.x + chartBorder, place.y + chartBorder), size(map.width, map.height);
    for (std::size_t v = 0; v < map.coords.size(); ++v)
      coords[scene.primitives[map.primitive].firstVertex + v] =
          glm::vec4((corner + map.coords[v] * size) / static_cast<float>(atlas.side), place.layer, 1.0f);
  }
  return coords;
}

ChartLighting::ChartLighting(const ChartTransfer& transfer, const CompiledScene& scene,
                             std::unique_ptr<DrawnTransfer> vertices)
    : transfer_(transfer),
      vertices_(std::move(vertices)),
      atlas_(chartAtlasOf(transfer)),
      coords_(Attribute::ChartCoord,
              std::span<const glm::vec4>(viewer::chartCoords(transfer, scene, atlas_))),
      radiance_(gl::makeFloatArray(atlas_.side, atlas_.layers, "light maps")) {}

void ChartLighting::light(const Illumination& light) {
  vertices_->light(light);
  const auto coefficients = farCoefficients(light, transfer_.order, FarLights::All);
  const std::vector<glm::vec3> floats(coefficients.begin(), coefficients.end());
  for (std::size_t m = 0; m < transfer_.maps.size(); ++m) {
    const ChartTransfer::Map& map = transfer_.maps[m];
    const ChartAtlas::Place& place = atlas_.places[m];
    gl::fillFloatArray(radiance_, {place.x, place.y, place.layer},
                       {map.width + 2 * chartBorder, map.height + 2 * chartBorder},
                       lightThrough(transfer_, map, floats));
  }
}

void ChartLighting::bind(const gl::Program& program) const {
  vertices_->bind(program);
  coords_.attach();
  gl::bind(lightMapsUnit, GL_TEXTURE_2D_ARRAY, radiance_);
}

void ChartLighting::describe(const Illumination& light, Warnings& notes) const {
  vertices_->describe(light, notes);
  noteFarLights(light, "light maps", notes);
}

}  // namespace prelight::viewer
