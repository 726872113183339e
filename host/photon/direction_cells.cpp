#include "photon/direction_cells.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace prelight {

namespace {

constexpr std::size_t mostBalls = 256;

/// Beyond the farthest of a cell's points that are looked at, and for the rounding of what the device makes
/// of a frame: radians and a share.
constexpr double slack = 1e-3;
constexpr double stretch = 1.05;

struct Cone {
  glm::dvec3 axis;
  double angle = 0.0;  ///< half of its opening
};

glm::dvec3 centroid(const CompiledScene& scene, std::uint32_t t) {
  const glm::uvec3& v = scene.triangles[t];
  return (glm::dvec3(scene.positions[v.x]) + glm::dvec3(scene.positions[v.y]) +
          glm::dvec3(scene.positions[v.z])) /
         3.0;
}

double angleBetween(const glm::dvec3& a, const glm::dvec3& b) {
  return std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b));
}

void split(const CompiledScene& scene, std::span<std::uint32_t> triangles, std::size_t most,
           std::vector<Ball>& balls) {
  if (triangles.size() == 1 || most <= 1) {
    balls.push_back(ballAround(scene, triangles));
    return;
  }
  glm::dvec3 lower(1e300), upper(-1e300);
  for (const std::uint32_t t : triangles) {
    lower = glm::min(lower, centroid(scene, t));
    upper = glm::max(upper, centroid(scene, t));
  }
  const glm::dvec3 extent = upper - lower;
  const int axis = extent.x >= extent.y && extent.x >= extent.z ? 0 : extent.y >= extent.z ? 1 : 2;
  const std::size_t half = triangles.size() / 2;
  std::nth_element(triangles.begin(), triangles.begin() + static_cast<std::ptrdiff_t>(half), triangles.end(),
                   [&](std::uint32_t a, std::uint32_t b) {
                     const double x = centroid(scene, a)[axis], y = centroid(scene, b)[axis];
                     return x != y ? x < y : a < b;
                   });
  split(scene, triangles.first(half), most / 2, balls);
  split(scene, triangles.subspan(half), most - most / 2, balls);
}

Cone coneOfCell(const DirectionFrame& frame, const DirectionMap& map, std::uint32_t cell,
                std::uint32_t side) {
  constexpr int steps = 4;
  const double u = cell % side, v = cell / side;
  Cone cone{directionOf(frame, map, (u + 0.5) / side, (v + 0.5) / side)};
  for (int i = 0; i <= steps; ++i)
    for (int j = 0; j <= steps; ++j)
      cone.angle =
          std::max(cone.angle, angleBetween(cone.axis, directionOf(frame, map, (u + double(i) / steps) / side,
                                                                   (v + double(j) / steps) / side)));
  cone.angle = stretch * cone.angle + slack;
  return cone;
}

}  // namespace

Ball ballAround(const CompiledScene& scene, std::span<const std::uint32_t> triangles) {
  glm::dvec3 lower(1e300), upper(-1e300);
  for (const std::uint32_t t : triangles) {
    for (int k = 0; k < 3; ++k) {
      lower = glm::min(lower, glm::dvec3(scene.positions[scene.triangles[t][k]]));
      upper = glm::max(upper, glm::dvec3(scene.positions[scene.triangles[t][k]]));
    }
  }
  return {0.5 * (lower + upper), 0.5 * glm::length(upper - lower)};
}

std::vector<Ball> clusterBalls(const CompiledScene& scene, std::vector<std::uint32_t> triangles) {
  std::vector<Ball> balls;
  split(scene, triangles, mostBalls, balls);
  return balls;
}

DirectionFrame frameAlong(const glm::dvec3& axis) {
  const glm::dvec3 aside = std::abs(axis.x) < 0.6 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0);
  return {axis, glm::normalize(glm::cross(axis, aside))};
}

glm::dvec3 directionOf(const DirectionFrame& frame, const DirectionMap& map, double u, double v) {
  const double cosine =
      map.kind == DirectionMap::Hemisphere ? std::sqrt(std::max(1.0 - v, 0.0)) : 1.0 - (1.0 - map.least) * v;
  const double sine = std::sqrt(std::max(1.0 - cosine * cosine, 0.0)), turn = 2.0 * std::numbers::pi * u;
  return sine * (std::cos(turn) * frame.tangent + std::sin(turn) * glm::cross(frame.axis, frame.tangent)) +
         cosine * frame.axis;
}

std::vector<std::uint32_t> cellsTowards(const Ball& from, std::span<const DirectionFrame> frames,
                                        const DirectionMap& map, std::span<const Ball> targets,
                                        std::uint32_t side) {
  std::vector<Cone> aims;
  bool inside = false;
  for (const Ball& target : targets) {
    const glm::dvec3 way = target.centre - from.centre;
    const double distance = glm::length(way), radius = target.radius + from.radius;
    inside = inside || distance <= radius;
    if (!inside) aims.push_back({way / distance, std::asin(radius / distance)});
  }
  std::vector<std::uint32_t> cells;
  for (std::uint32_t cell = 0; cell < side * side; ++cell) {
    bool meets = inside;
    for (std::size_t f = 0; f < frames.size() && !meets; ++f) {
      const Cone cone = coneOfCell(frames[f], map, cell, side);
      meets = std::any_of(aims.begin(), aims.end(), [&](const Cone& a) {
        return angleBetween(cone.axis, a.axis) <= cone.angle + a.angle;
      });
    }
    if (meets) cells.push_back(cell);
  }
  return cells;
}

}  // namespace prelight
