#include "plot/balloon.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "scene/surface/triangles.h"

namespace prelight::plot {
namespace {

constexpr int fineness = 2;  // samples per pixel along each axis

/// The samples of a square, finer than its pixels.
struct Square {
  explicit Square(int pixels)
      : side(fineness * pixels),
        depths(static_cast<std::size_t>(side) * side, -std::numeric_limits<double>::infinity()),
        colors(depths.size(), glm::dvec3(255.0)) {}

  int side;
  std::vector<double> depths;
  std::vector<glm::dvec3> colors;
};

/// Returns the axes right, up and towards the eye, as columns.
glm::dmat3 viewOf(UpAxis axis) {
  const bool z = axis == UpAxis::Z;
  const glm::dvec3 up = z ? glm::dvec3(0, 0, 1) : glm::dvec3(0, 1, 0);
  const glm::dvec3 towards = glm::normalize(z ? glm::dvec3(1.0, 0.55, 0.5) : glm::dvec3(0.4, 0.5, 1.0));
  const glm::dvec3 right = glm::normalize(glm::cross(up, towards));
  return {right, glm::cross(towards, right), towards};
}

glm::dvec3 shaded(const glm::dvec3& normal, const glm::dvec3& towards, bool isPositive) {
  const Color& color = isPositive ? positiveColor : negativeColor;
  const double light =
      0.35 + 0.65 * std::abs(glm::dot(normal, glm::normalize(towards + glm::dvec3(0.2, 0.3, 0.2))));
  return light * glm::dvec3(color[0], color[1], color[2]);
}

/// Draws a triangle; places are samples and depths.
void fill(Square& square, const std::array<glm::dvec3, 3>& p, const glm::dvec3& color) {
  const glm::dvec2 a(p[0]), b(p[1]), c(p[2]);
  const double area = cross(b - a, c - a);
  if (std::abs(area) < 1e-9) return;
  const glm::dvec2 low = glm::min(glm::min(a, b), c), high = glm::max(glm::max(a, b), c);
  for (int y = std::max(0, static_cast<int>(low.y)); y <= std::min<double>(square.side - 1, high.y); ++y)
    for (int x = std::max(0, static_cast<int>(low.x)); x <= std::min<double>(square.side - 1, high.x); ++x) {
      const glm::dvec2 q(x + 0.5, y + 0.5);
      const double u = cross(c - b, q - b) / area, v = cross(a - c, q - c) / area, w = 1.0 - u - v;
      if (std::min({u, v, w}) < 0.0) continue;
      const double depth = u * p[0].z + v * p[1].z + w * p[2].z;
      const std::size_t at = static_cast<std::size_t>(y) * square.side + x;
      if (depth <= square.depths[at]) continue;
      square.depths[at] = depth;
      square.colors[at] = color;
    }
}

void copyTo(Drawing& drawing, const glm::ivec2& corner, const Square& square) {
  const int side = square.side / fineness;
  for (int y = 0; y < side; ++y)
    for (int x = 0; x < side; ++x) {
      glm::dvec3 sum(0.0);
      for (int i = 0; i < fineness * fineness; ++i)
        sum += square.colors[static_cast<std::size_t>(fineness * y + i / fineness) * square.side +
                             fineness * x + i % fineness];
      const glm::dvec3 mean = sum / static_cast<double>(fineness * fineness);
      drawing.set(corner.x + x, corner.y + y,
                  {static_cast<std::uint8_t>(std::lround(std::min(mean.x, 255.0))),
                   static_cast<std::uint8_t>(std::lround(std::min(mean.y, 255.0))),
                   static_cast<std::uint8_t>(std::lround(std::min(mean.z, 255.0)))});
    }
}

}  // namespace

SphereGrid makeSphereGrid(int rows, int columns) {
  SphereGrid grid{rows, columns, {}};
  for (int row = 0; row < rows; ++row)
    for (int column = 0; column < columns; ++column) {
      const double polar = std::numbers::pi * row / (rows - 1),
                   turn = 2.0 * std::numbers::pi * column / (columns - 1);
      grid.directions.emplace_back(std::sin(polar) * std::cos(turn), std::sin(polar) * std::sin(turn),
                                   std::cos(polar));
    }
  return grid;
}

void drawBalloon(Drawing& drawing, const glm::ivec2& corner, int side, const SphereGrid& grid,
                 const std::vector<double>& values, double scale, UpAxis up) {
  const glm::dmat3 view = viewOf(up);
  const double radius = 0.48 * fineness * side / scale, middle = 0.5 * fineness * side;
  Square square(side);
  const auto pointAt = [&](std::size_t i) { return grid.directions[i] * std::abs(values[i]); };
  const auto seen = [&](const glm::dvec3& p) {
    const glm::dvec3 q = glm::transpose(view) * p * radius;
    return glm::dvec3(middle + q.x, middle - q.y, q.z);
  };
  const auto triangle = [&](std::size_t a, std::size_t b, std::size_t c) {
    const glm::dvec3 normal = glm::cross(pointAt(b) - pointAt(a), pointAt(c) - pointAt(a));
    const double length = glm::length(normal);
    if (length <= 0.0) return;
    fill(square, {seen(pointAt(a)), seen(pointAt(b)), seen(pointAt(c))},
         shaded(normal / length, view[2], values[a] + values[b] + values[c] > 0.0));
  };
  for (int row = 0; row + 1 < grid.rows; ++row)
    for (int column = 0; column + 1 < grid.columns; ++column) {
      const std::size_t a = static_cast<std::size_t>(row) * grid.columns + column, b = a + grid.columns;
      triangle(a, b, b + 1);
      triangle(a, b + 1, a + 1);
    }
  copyTo(drawing, corner, square);
}

}  // namespace prelight::plot
