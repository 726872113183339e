#pragma once

#include <array>
#include <glm/glm.hpp>

#include "prelight/light_map.h"

namespace prelight {

/// The square between texel (x, y) of a layout and those to the right, below and diagonally below: shares of
/// its edges at which walls cross them. kernels/shared/walled_square.h explains their meaning.
struct SquareWalls {
  float top = LightMapLayout::noWall;
  float bottom = LightMapLayout::noWall;
  float left = LightMapLayout::noWall;
  float right = LightMapLayout::noWall;

  bool any() const;
};

SquareWalls wallsOf(const LightMapLayout& layout, int x, int y);

/// Returns the weights of (x, y), (x + 1, y), (x, y + 1), (x + 1, y + 1) at a point of the square, at
/// `share`, 0 to 1, from the first: bilinear among those on the point's side of the walls. Walls that are
/// only partly known give two answers, of which `wide` selects the first; look-ups take the darker one.
std::array<double, 4> walledWeights(const SquareWalls& walls, const glm::dvec2& share, bool wide);

}  // namespace prelight
