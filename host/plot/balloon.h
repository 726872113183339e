#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "plot/drawing.h"

namespace prelight::plot {

/// Directions of a grid over the sphere, [row][column], from the axis up to the opposite one. Each row begins
/// and ends at the same azimuth.
struct SphereGrid {
  int rows = 0;
  int columns = 0;
  std::vector<glm::dvec3> directions;
};

/// Returns a grid about the axis +Z.
SphereGrid makeSphereGrid(int rows, int columns);

/// Which axis of the world points up in a picture of a function.
enum class UpAxis { Y, Z };

/// Draws a function on the sphere into a square: the surface whose distance from the centre is the function's
/// magnitude, blue where the function is positive and orange where it is negative. `values` belong to the
/// directions of the grid; `scale` is the magnitude that reaches the border.
void drawBalloon(Drawing& drawing, const glm::ivec2& corner, int side, const SphereGrid& grid,
                 const std::vector<double>& values, double scale, UpAxis up);

}  // namespace prelight::plot
