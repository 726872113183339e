#include "charts/chart_texels.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "charts/cross.h"
#include "receivers/surface_sampler.h"

namespace prelight {

namespace {

/// Distance, in texels, between a chart's edge and the centres of its outer texels: look-ups that the
/// hardware rounds to 1/256 of a texel then still meet no other chart.
constexpr double margin = 1.0 / 64.0;
/// Distance from a texel's centre, in texels, within which look-ups give it a noticeable weight.
constexpr double reachOfTexel = 0.999;
constexpr double noDistance = 1e30;

/// The texel centres along a side of `length` texels: their number, the scale of the side, and its start.
struct Span {
  int steps = 1;
  double scale = 1.0;  ///< factor of lengths in texels
  double start = 0.5;
};

Span spanOf(double length) {
  const double inner = 1.0 - 2.0 * margin;
  Span span;
  if (length <= inner) {
    span.start = 0.5 + 0.5 * (1.0 - length);
  } else if (length < 2.0) {
    span.steps = 2;
    span.start = 0.5 + 0.5 * (2.0 - length);
    if (length > 1.0 + inner) {
      span.scale = (1.0 + inner) / length;
      span.start = 0.5 + margin;
    }
  } else {
    span.steps = static_cast<int>(std::lround(length));
    span.scale = (span.steps - 2.0 * margin) / length;
    span.start = 0.5 + margin;
  }
  return span;
}

/// Returns true when a triangle reaches into the square of side 2 around a point, where look-ups meet that
/// texel (separating axes).
bool comesNear(const std::array<glm::dvec2, 3>& c, const glm::dvec2& centre) {
  for (int i = 0; i < 3; ++i) {
    const glm::dvec2 edge = c[(i + 1) % 3] - c[i];
    const glm::dvec2 normal(-edge.y, edge.x);
    const double reach = reachOfTexel * (std::abs(normal.x) + std::abs(normal.y));
    if (reach == 0.0) continue;
    double low = 1e300, high = -1e300;
    for (const glm::dvec2& p : c) {
      const double d = glm::dot(p - centre, normal);
      low = std::min(low, d);
      high = std::max(high, d);
    }
    if (low >= reach || high <= -reach) return false;
  }
  return true;
}

struct Nearest {
  double distance = noDistance;
  glm::dvec2 weights{1.0 / 3.0};  ///< barycentric weights of corners 1 and 2
};

/// Returns the nearest point of a triangle.
Nearest nearestOn(const std::array<glm::dvec2, 3>& c, const glm::dvec2& p) {
  const double area = cross(c[1] - c[0], c[2] - c[0]);
  if (std::abs(area) > 1e-12) {
    const double second = cross(p - c[0], c[2] - c[0]) / area, third = cross(c[1] - c[0], p - c[0]) / area;
    if (std::min({1.0 - second - third, second, third}) >= 0.0) return {0.0, {second, third}};
  }
  Nearest best;
  for (int i = 0; i < 3; ++i) {
    const int k = (i + 1) % 3;
    const glm::dvec2 edge = c[k] - c[i];
    const double squared = glm::dot(edge, edge);
    const double s = squared > 0.0 ? std::clamp(glm::dot(p - c[i], edge) / squared, 0.0, 1.0) : 0.0;
    const double distance = glm::distance(p, c[i] + s * edge);
    if (distance >= best.distance) continue;
    glm::dvec3 weights(0.0);
    weights[i] = 1.0 - s;
    weights[k] = s;
    best = {distance, {weights.y, weights.z}};
  }
  return best;
}

/// Finds the nearest triangle for every texel of a rectangle.
class TexelFinder {
 public:
  TexelFinder(int width, int height)
      : width_(width),
        height_(height),
        nearest_(static_cast<std::size_t>(width) * static_cast<std::size_t>(height)),
        triangle_(nearest_.size(), 0) {}

  void add(std::uint32_t triangle, const std::array<glm::dvec2, 3>& c) {
    const glm::dvec2 low = glm::min(c[0], glm::min(c[1], c[2])), high = glm::max(c[0], glm::max(c[1], c[2]));
    const auto first = [](double coordinate) {
      return std::max(0, static_cast<int>(std::floor(coordinate - 1.5)));
    };
    const auto last = [](double coordinate, int count) {
      return std::min(count - 1, static_cast<int>(std::ceil(coordinate + 0.5)));
    };
    for (int y = first(low.y); y <= last(high.y, height_); ++y)
      for (int x = first(low.x); x <= last(high.x, width_); ++x) {
        const glm::dvec2 centre(x + 0.5, y + 0.5);
        if (centre.x <= low.x - reachOfTexel || centre.x >= high.x + reachOfTexel ||
            centre.y <= low.y - reachOfTexel || centre.y >= high.y + reachOfTexel)
          continue;
        const std::size_t at =
            static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(x);
        if (nearest_[at].distance == 0.0 || !comesNear(c, centre)) continue;
        const Nearest found = nearestOn(c, centre);
        if (found.distance >= nearest_[at].distance) continue;
        nearest_[at] = found;
        triangle_[at] = triangle;
      }
  }

  void giveTo(ChartTexels& chart) const {
    chart.mask = {width_, height_, std::vector<std::uint8_t>(nearest_.size(), 0)};
    for (std::size_t at = 0; at < nearest_.size(); ++at) {
      if (nearest_[at].distance == noDistance) continue;
      chart.mask.cells[at] = 1;
      chart.places.push_back({static_cast<std::uint32_t>(at % static_cast<std::size_t>(width_)),
                              static_cast<std::uint32_t>(at / static_cast<std::size_t>(width_)),
                              triangle_[at], nearest_[at].weights});
    }
  }

 private:
  int width_, height_;
  std::vector<Nearest> nearest_;
  std::vector<std::uint32_t> triangle_;
};

/// Returns a chart all of whose corners are at the centre of one texel.
ChartTexels singleTexel(const LightMapChart& chart) {
  ChartTexels result;
  result.corners.assign(chart.corners.size(), glm::vec2(0.5f));
  std::uint32_t largest = 0;
  double largestArea = -1.0;
  for (std::uint32_t t = 0; t < chart.triangles.size(); ++t) {
    const glm::vec2* c = &chart.corners[3 * std::size_t{t}];
    const double area = std::abs(cross(glm::dvec2(c[1] - c[0]), glm::dvec2(c[2] - c[0])));
    if (area > largestArea) largest = t, largestArea = area;
  }
  result.places.push_back({0, 0, largest, glm::dvec2(1.0 / 3.0)});
  result.mask = {1, 1, {1}};
  return result;
}

}  // namespace

ChartTexels makeChartTexels(const LightMapChart& chart, double texelSize) {
  const glm::dvec2 size = chart.size / texelSize;
  if (std::max(size.x, size.y) < leastChartAcross) return singleTexel(chart);
  const Span across = spanOf(size.x), down = spanOf(size.y);
  ChartTexels result;
  result.corners.reserve(chart.corners.size());
  for (const glm::vec2& corner : chart.corners) {
    const glm::dvec2 p = glm::dvec2(corner) / texelSize;
    result.corners.emplace_back(across.start + across.scale * p.x, down.start + down.scale * p.y);
  }
  return findChartTexels(std::move(result.corners), across.steps + 1, down.steps + 1);
}

ChartTexels findChartTexels(std::vector<glm::vec2> corners, int width, int height) {
  ChartTexels result;
  result.corners = std::move(corners);
  TexelFinder finder(width, height);
  for (std::uint32_t t = 0; 3 * std::size_t{t} < result.corners.size(); ++t) {
    const glm::vec2* c = &result.corners[3 * std::size_t{t}];
    finder.add(t, {glm::dvec2(c[0]), glm::dvec2(c[1]), glm::dvec2(c[2])});
  }
  finder.giveTo(result);
  return result;
}

LightMapTexel texelOnMap(const CompiledScene& scene, const ChartTexels::Place& place, std::uint32_t face,
                         const glm::ivec2& origin, int width) {
  const glm::dvec2 b = keptOffEdges(scene, face % scene.triangleCount(), place.weights);
  const std::uint32_t x = static_cast<std::uint32_t>(origin.x) + place.x,
                      y = static_cast<std::uint32_t>(origin.y) + place.y;
  return {y * static_cast<std::uint32_t>(width) + x, face, static_cast<float>(b.x), static_cast<float>(b.y)};
}

}  // namespace prelight
