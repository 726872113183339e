#include "charts/chart_shape.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "scene/surface/triangles.h"

namespace prelight {
namespace {

constexpr double leastCells = 1 << 10, cellsPerTriangle = 1 << 8, mostCells = 1 << 20;
constexpr double edgeWidth =
    1e-3;  // share of a height: nearer to an edge, neighbours may both contain a point

/// Returns the convex hull, counter-clockwise (Andrew's monotone chain).
std::vector<glm::dvec2> hullOf(std::vector<glm::dvec2> points) {
  const auto before = [](const glm::dvec2& a, const glm::dvec2& b) {
    return a.x != b.x ? a.x < b.x : a.y < b.y;
  };
  std::sort(points.begin(), points.end(), before);
  points.erase(std::unique(points.begin(), points.end()), points.end());
  if (points.size() < 3) return points;
  std::vector<glm::dvec2> hull;
  const auto add = [&](const glm::dvec2& p, std::size_t kept) {
    while (hull.size() >= kept + 2 && cross(hull.back() - hull[hull.size() - 2], p - hull.back()) <= 0.0)
      hull.pop_back();
    hull.push_back(p);
  };
  for (const glm::dvec2& p : points) add(p, 0);
  const std::size_t kept = hull.size() - 1;
  for (std::size_t i = points.size() - 1; i-- > 0;) add(points[i], kept);
  hull.pop_back();
  return hull;
}

struct Extent {
  glm::dvec2 low{1e300}, high{-1e300};

  void add(const glm::dvec2& p) {
    low = glm::min(low, p);
    high = glm::max(high, p);
  }
  glm::dvec2 size() const { return high - low; }
};

glm::dvec2 turned(const glm::dvec2& p, const glm::dvec2& along) {
  return {glm::dot(p, along), cross(along, p)};
}

/// Returns the direction of the hull's edge along which the bounding rectangle is smallest. For hulls of many
/// edges only some are tried.
glm::dvec2 bestDirection(const std::vector<glm::dvec2>& hull) {
  constexpr std::size_t mostTried = 256;
  glm::dvec2 best(1.0, 0.0);
  double bestArea = 1e300, bestLength = 0.0;
  const std::size_t stride = (hull.size() + mostTried - 1) / mostTried;
  for (std::size_t i = 0; i < hull.size(); i += std::max<std::size_t>(stride, 1)) {
    const glm::dvec2 edge = hull[(i + 1) % hull.size()] - hull[i];
    const double length = glm::length(edge);
    if (!(length > 0.0)) continue;
    Extent extent;
    for (const glm::dvec2& p : hull) extent.add(turned(p, edge / length));
    const double area = extent.size().x * extent.size().y;
    const bool equal = std::abs(area - bestArea) <= 1e-6 * bestArea;
    if (equal ? length <= bestLength * (1.0 + 1e-6) : area > bestArea) continue;
    best = edge / length;
    bestArea = area;
    bestLength = length;
  }
  return best;
}

double areaOf(const std::vector<glm::dvec2>& corners) {
  double sum = 0.0;
  for (std::size_t c = 0; c + 2 < corners.size(); c += 3)
    sum += 0.5 * std::abs(cross(corners[c + 1] - corners[c], corners[c + 2] - corners[c]));
  return sum;
}

/// The points of a grid over a shape, and whether they are occupied.
class PointGrid {
 public:
  explicit PointGrid(const ChartShape& shape) {
    const double triangles = static_cast<double>(shape.corners.size()) / 3.0;
    const double cells = std::clamp(cellsPerTriangle * triangles, leastCells, mostCells);
    const glm::dvec2 size = glm::max(shape.size, glm::dvec2(1e-6 * std::max(shape.size.x, 1e-300)));
    cell_ = std::max(std::sqrt(size.x * size.y / cells), size.x / mostCells);
    columns_ = static_cast<std::size_t>(size.x / cell_) + 1;
    rows_ = static_cast<std::size_t>(size.y / cell_) + 1;
    taken_.assign(columns_ * rows_, 0);
  }

  /// Occupies the points inside a triangle. Returns false and occupies none if one of them is occupied.
  bool take(const glm::dvec2* corners) {
    inside_.clear();
    const glm::dvec2 &a = corners[0], &b = corners[1], &c = corners[2];
    const double area = cross(b - a, c - a);
    if (!(std::abs(area) > 0.0)) return true;
    const glm::dvec2 low = glm::min(a, glm::min(b, c)), high = glm::max(a, glm::max(b, c));
    const std::size_t lastColumn = lineBelow(high.x, columns_), lastRow = lineBelow(high.y, rows_);
    for (std::size_t row = lineBelow(low.y, rows_); row <= lastRow; ++row)
      for (std::size_t column = lineBelow(low.x, columns_); column <= lastColumn; ++column) {
        const glm::dvec2 p = (glm::dvec2(column, row) + 0.5) * cell_;
        const double second = cross(p - a, c - a) / area, third = cross(b - a, p - a) / area;
        if (std::min({1.0 - second - third, second, third}) < edgeWidth) continue;
        const std::size_t at = row * columns_ + column;
        if (taken_[at] != 0) return false;
        inside_.push_back(at);
      }
    for (const std::size_t at : inside_) taken_[at] = 1;
    return true;
  }

 private:
  std::size_t lineBelow(double coordinate, std::size_t count) const {
    return static_cast<std::size_t>(
        std::clamp(coordinate / cell_ - 0.5, 0.0, static_cast<double>(count - 1)));
  }

  double cell_ = 1.0;
  std::size_t columns_ = 1, rows_ = 1;
  std::vector<std::uint8_t> taken_;
  std::vector<std::size_t> inside_;
};

}  // namespace

ChartShape shapeOf(std::vector<glm::dvec2> corners, double area) {
  ChartShape shape{std::move(corners), {}};
  const glm::dvec2 along = bestDirection(hullOf(shape.corners));
  Extent extent;
  for (glm::dvec2& p : shape.corners) {
    p = turned(p, along);
    extent.add(p);
  }
  const bool tall = extent.size().y > extent.size().x;
  const double flat = areaOf(shape.corners);
  const double scale = flat > 1e-3 * area ? std::sqrt(area / flat) : 1.0;
  for (glm::dvec2& p : shape.corners) {
    p = (p - extent.low) * scale;
    if (tall) p = {extent.size().y * scale - p.y, p.x};  // a quarter turn
  }
  shape.size = extent.size() * scale;
  if (tall) std::swap(shape.size.x, shape.size.y);
  return shape;
}

std::vector<std::uint8_t> withoutOverlap(const ChartShape& shape, std::span<const std::uint32_t> order) {
  std::vector<std::uint8_t> free(shape.corners.size() / 3, 1);
  if (free.size() < 2) return free;
  PointGrid grid(shape);
  for (const std::uint32_t t : order) free[t] = grid.take(&shape.corners[3 * std::size_t{t}]) ? 1 : 0;
  return free;
}

}  // namespace prelight
