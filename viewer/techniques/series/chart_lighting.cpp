#include "viewer/techniques/series/chart_lighting.h"

#include <algorithm>

#include "base/parallel.h"
#include "basis/sh_evaluate.h"
#include "basis/sh_zonal.h"
#include "relight/sky_ringing.h"
#include "viewer/lights/receiver_lamps.h"

namespace prelight::viewer {
namespace {

constexpr std::size_t texelGrain = 512;  ///< texels that a thread takes at once

/// Coefficients of a texel, RGB: one channel is that of all.
class TexelRow {
 public:
  TexelRow(const ChartTransfer& transfer, const ChartTransfer::Map& map, std::size_t texel)
      : length_(static_cast<std::size_t>(transfer.order * transfer.order)),
        step_(transfer.channels == 3 ? length_ : 0),
        row_(&map.coefficients[texel * transfer.rowLength()]) {}

  std::size_t length() const { return length_; }
  glm::vec3 at(std::size_t i) const { return {row_[i], row_[step_ + i], row_[2 * step_ + i]}; }

 private:
  std::size_t length_, step_;
  const float* row_;
};

/// Radiance of a map's texels before albedo, without its border: [row][column].
std::vector<glm::vec3> lightThrough(const ChartTransfer& transfer, const ChartTransfer::Map& map,
                                    const std::vector<glm::vec3>& light) {
  std::vector<glm::vec3> radiance(map.texels(), glm::vec3(0.0f));
  parallelRanges(radiance.size(), texelGrain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t texel = begin; texel < end; ++texel) {
      const TexelRow row(transfer, map, texel);
      for (std::size_t i = 0; i < row.length(); ++i) radiance[texel] += light[i] * row.at(i);
    }
  });
  return radiance;
}

/// Adds the light of lamps. Normals of a normal map are not known here, so that shares that are less than 1
/// may be theirs and are not sharpened.
void addLamps(const ChartTransfer& transfer, const ChartTransfer::Map& map,
              const std::vector<ChartPlace>& places, const std::vector<ShadedLight>& lamps, bool bumped,
              std::vector<glm::vec3>& radiance) {
  const bool sharp = transfer.channels == 1 && !bumped;
  parallelRanges(radiance.size(), texelGrain, [&](std::size_t begin, std::size_t end) {
    std::vector<double> basis(static_cast<std::size_t>(transfer.order * transfer.order));
    for (std::size_t texel = begin; texel < end; ++texel) {
      const TexelRow row(transfer, map, texel);
      for (const ShadedLight& lamp : lamps) {
        const SeenLamp seen =
            seenFrom(lamp, glm::dvec3(places[texel].position), glm::dvec3(places[texel].normal));
        if (!seen.shines()) continue;
        sh::evaluate(seen.toLamp, transfer.order, basis);
        glm::dvec3 through(0.0);
        for (std::size_t i = 0; i < row.length(); ++i) through += basis[i] * glm::dvec3(row.at(i));
        const double open = sh::openTowards(seen.cosine, transfer.order);
        radiance[texel] += glm::vec3(lampThroughTransfer(seen, through, open, sharp));
      }
    }
  });
}

/// A map with the border around it. A truncated series may dip below zero, which is dark.
std::vector<glm::vec3> withBorder(const ChartTransfer::Map& map, const std::vector<glm::vec3>& radiance) {
  std::vector<glm::vec3> bordered;
  for (int row = -chartBorder; row < map.height + chartBorder; ++row)
    for (int column = -chartBorder; column < map.width + chartBorder; ++column) {
      const int x = std::clamp(column, 0, map.width - 1), y = std::clamp(row, 0, map.height - 1);
      bordered.push_back(glm::max(radiance[static_cast<std::size_t>(y * map.width + x)], glm::vec3(0.0f)));
    }
  return bordered;
}

}  // namespace

bool hasBumps(const CompiledScene& scene, const ChartTransfer::Map& map) {
  const std::uint32_t triangle = scene.primitives[map.primitive].firstTriangle;
  return triangle < scene.triangleCount() &&
         scene.materials[scene.triangleMaterials[triangle]].normalTexture.image >= 0;
}

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
      scene_(scene),
      vertices_(std::move(vertices)),
      atlas_(chartAtlasOf(transfer)),
      coords_(Attribute::ChartCoord,
              std::span<const glm::vec4>(viewer::chartCoords(transfer, scene, atlas_))),
      radiance_(gl::makeFloatArray(atlas_.side, atlas_.layers, "light maps")) {}

void ChartLighting::light(const Illumination& light) {
  vertices_->light(light);
  const auto coefficients = skyCoefficients(light, transfer_.order);
  const auto smoothing = smoothedCoefficients(light, transfer_.order);
  const std::vector<glm::vec3> floats(coefficients.begin(), coefficients.end()),
      smoothed(smoothing.begin(), smoothing.end());
  const std::vector<ShadedLight> lamps = transferredLights(light);
  lampsShine_ = !lamps.empty();
  if (lampsShine_ && places_.empty())
    for (const ChartTransfer::Map& map : transfer_.maps) places_.push_back(placesOf(map, scene_));
  for (std::size_t m = 0; m < transfer_.maps.size(); ++m) {
    const ChartTransfer::Map& map = transfer_.maps[m];
    const ChartAtlas::Place& place = atlas_.places[m];
    std::vector<glm::vec3> radiance = lightThrough(transfer_, map, floats);
    const std::vector<glm::vec3> least = lightThrough(transfer_, map, smoothed);
    for (std::size_t texel = 0; texel < radiance.size(); ++texel)
      for (int c = 0; c < 3; ++c)
        radiance[texel][c] = static_cast<float>(withoutRinging(radiance[texel][c], least[texel][c]));
    if (lampsShine_) addLamps(transfer_, map, places_[m], lamps, hasBumps(scene_, map), radiance);
    gl::fillFloatArray(radiance_, {place.x, place.y, place.layer},
                       {map.width + 2 * chartBorder, map.height + 2 * chartBorder},
                       withBorder(map, radiance));
  }
}

bool ChartLighting::verticesMoved() {
  places_.clear();
  return vertices_->verticesMoved() || lampsShine_;
}

void ChartLighting::bind(const gl::Program& program) const {
  vertices_->bind(program);
  coords_.attach();
  gl::bind(lightMapsUnit, GL_TEXTURE_2D_ARRAY, radiance_);
}

void ChartLighting::describe(const Illumination& light, Warnings& notes) const {
  vertices_->describe(light, notes);
}

}  // namespace prelight::viewer
