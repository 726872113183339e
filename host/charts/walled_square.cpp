#include "charts/walled_square.h"

#include <algorithm>

namespace prelight {

namespace {

using glm::vec4;

// OpenCL C that is C++ as well. Its macros must not reach other sources: this one is compiled by itself.
#include "gather/walled_square_funcs.cl"

static_assert(LightMapLayout::noWall == PRELIGHT_NO_WALL);

}  // namespace

bool SquareWalls::any() const { return hasWalls(WalledSquare{top, bottom, left, right}); }

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
  const vec4 weights = walledWeights(WalledSquare{walls.top, walls.bottom, walls.left, walls.right},
                                     static_cast<float>(share.x), static_cast<float>(share.y), wide);
  return {weights.x, weights.y, weights.z, weights.w};
}

}  // namespace prelight
