#include "charts/light_map_lookup.h"

#include <algorithm>
#include <cmath>

#include "base/colour.h"
#include "shared/walled_square.h"

namespace prelight {

static_assert(LightMapLayout::noWall == PRELIGHT_NO_WALL);

namespace {

device::WalledSquare onDevice(const SquareWalls& walls) {
  return {walls.top, walls.bottom, walls.left, walls.right};
}

}  // namespace

bool SquareWalls::any() const { return device::hasWalls(onDevice(*this)); }

SquareWalls wallsOf(const LightMapLayout& layout, int x, int y) {
  if (layout.walls.empty()) return {};
  const auto at = [&](int column, int row) -> const LightMapLayout::Wall& {
    return layout.walls[static_cast<std::size_t>(std::clamp(row, 0, layout.height - 1)) *
                            static_cast<std::size_t>(layout.width) +
                        static_cast<std::size_t>(std::clamp(column, 0, layout.width - 1))];
  };
  return {at(x, y).right, at(x, y + 1).right, at(x, y).below, at(x + 1, y).below};
}

std::array<double, 4> walledWeights(const SquareWalls& walls, const glm::dvec2& share, bool wide) {
  const device::SquareWeights w =
      device::walledWeights(onDevice(walls), static_cast<float>(share.x), static_cast<float>(share.y), wide);
  return {w.leftTop, w.rightTop, w.leftBottom, w.rightBottom};
}

glm::dvec2 lightMapPlace(const LightMapLayout& layout, std::uint32_t face, double b1, double b2) {
  const glm::vec2* c = &layout.corners[3 * std::size_t{face}];
  return (1.0 - b1 - b2) * glm::dvec2(c[0]) + b1 * glm::dvec2(c[1]) + b2 * glm::dvec2(c[2]);
}

double texelsOf(const LightMapLayout& layout, std::uint32_t face) {
  const glm::vec2* c = &layout.corners[3 * std::size_t{face}];
  const glm::dvec2 e = glm::dvec2(c[1]) - glm::dvec2(c[0]), f = glm::dvec2(c[2]) - glm::dvec2(c[0]);
  return 0.5 * std::abs(e.x * f.y - e.y * f.x);
}

LightMapLookUp lookUp(const LightMapLayout& layout, const glm::dvec2& place, bool wide) {
  const glm::dvec2 low = glm::floor(place - 0.5), share = place - 0.5 - low;
  const glm::ivec2 first(low);
  LightMapLookUp result;
  for (std::size_t i = 0; i < 4; ++i) {
    const int x = std::clamp(first.x + static_cast<int>(i % 2), 0, layout.width - 1),
              y = std::clamp(first.y + static_cast<int>(i / 2), 0, layout.height - 1);
    result.texels[i] = static_cast<std::uint32_t>(y) * static_cast<std::uint32_t>(layout.width) +
                       static_cast<std::uint32_t>(x);
    result.weights[i] = (i % 2 != 0 ? share.x : 1.0 - share.x) * (i / 2 != 0 ? share.y : 1.0 - share.y);
  }
  const SquareWalls walls = wallsOf(layout, first.x, first.y);
  if (walls.any()) result.weights = walledWeights(walls, share, wide);
  return result;
}

LightMapLookUp lookUp(const LightMap& map, const glm::dvec2& place) {
  const LightMapLookUp wide = lookUp(map.layout, place, true);
  if (map.layout.walls.empty()) return wide;
  const LightMapLookUp narrow = lookUp(map.layout, place, false);
  return luminance(lightMapValue(map, narrow)) < luminance(lightMapValue(map, wide)) ? narrow : wide;
}

glm::dvec3 lightMapValue(const LightMap& map, const LightMapLookUp& at, int coefficient) {
  const auto length = static_cast<std::size_t>(map.coefficients);
  glm::dvec3 sum(0.0);
  for (std::size_t i = 0; i < 4; ++i)
    for (int channel = 0; channel < 3; ++channel)
      sum[channel] +=
          at.weights[i] * map.values[(3 * std::size_t{at.texels[i]} + std::size_t(channel)) * length +
                                     static_cast<std::size_t>(coefficient)];
  return sum;
}

glm::dvec3 lightMapIrradiance(const LightMap& map, std::uint32_t face, double b1, double b2) {
  return lightMapValue(map, lookUp(map, lightMapPlace(map.layout, face, b1, b2)));
}

}  // namespace prelight
