#include "charts/walled_square.h"

#include <algorithm>

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

}  // namespace prelight
