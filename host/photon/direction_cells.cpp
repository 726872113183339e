#include "photon/direction_cells.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

namespace prelight {

namespace {

constexpr std::size_t mostBalls = 256;

/// Margins of a cell's cone, an angle in radians and a factor, beyond the sampled directions and for rounding
/// on the device.
constexpr double slack = 1e-3;
constexpr double stretch = 1.05;

constexpr int steps = 4;  ///< sampled points along a cell's sides

struct Cone {
  glm::dvec3 axis;
  double angle = 0.0;  ///< half the opening angle
  double cosine = 1.0;
  double sine = 0.0;
};

Cone makeCone(const glm::dvec3& axis, double angle) {
  return {axis, angle, std::cos(angle), std::sin(angle)};
}

/// Returns whether cones overlap; true in case of doubt.
bool meet(const Cone& a, const Cone& b) {
  return a.angle + b.angle >= std::numbers::pi ||
         glm::dot(a.axis, b.axis) >= a.cosine * b.cosine - a.sine * b.sine - 1e-12;
}

glm::dvec3 centroid(const CompiledScene& scene, std::uint32_t t) {
  const glm::uvec3& v = scene.triangles[t];
  return (glm::dvec3(scene.positions[v.x]) + glm::dvec3(scene.positions[v.y]) +
          glm::dvec3(scene.positions[v.z])) /
         3.0;
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

/// The directions of the square at `steps` points per cell and side, in a frame with axis z and tangent x.
class DirectionLattice {
 public:
  DirectionLattice(const DirectionMap& map, std::uint32_t side) : side_(side) {
    const DirectionFrame local{{0.0, 0.0, 1.0}, {1.0, 0.0, 0.0}};
    const std::uint32_t count = 2 * steps * side;  // twice as fine, so that the centres of cells are included
    for (std::uint32_t i = 0; i <= count; ++i) {
      const double turn = 2.0 * std::numbers::pi * i / count;
      turns_.emplace_back(std::cos(turn), std::sin(turn));
      const glm::dvec3 d = directionOf(local, map, 0.0, double(i) / count);
      heights_.emplace_back(d.x, d.z);
    }
  }

  /// Returns a cone around all directions of a cell.
  Cone cone(const DirectionFrame& frame, std::uint32_t cell) const {
    const std::uint32_t u = 2 * steps * (cell % side_), v = 2 * steps * (cell / side_);
    const glm::dvec3 middle = at(u + steps, v + steps);
    double least = 1.0;
    for (std::uint32_t i = 0; i <= steps; ++i)
      for (std::uint32_t j = 0; j <= steps; ++j)
        least = std::min(least, glm::dot(middle, at(u + 2 * i, v + 2 * j)));
    return makeCone(
        middle.x * frame.tangent + middle.y * glm::cross(frame.axis, frame.tangent) + middle.z * frame.axis,
        stretch * std::acos(std::clamp(least, -1.0, 1.0)) + slack);
  }

 private:
  glm::dvec3 at(std::uint32_t u, std::uint32_t v) const {
    return {heights_[v].x * turns_[u].x, heights_[v].x * turns_[u].y, heights_[v].y};
  }

  std::uint32_t side_;
  std::vector<glm::dvec2> turns_;    ///< cosine, sine
  std::vector<glm::dvec2> heights_;  ///< sine and cosine of the angle with the axis
};

/// Returns the cone of directions from points of one ball to another, or nothing if they overlap, so that any
/// direction is possible.
std::optional<Cone> coneTowards(const Ball& from, const Ball& target) {
  const glm::dvec3 way = target.centre - from.centre;
  const double distance = glm::length(way), radius = target.radius + from.radius;
  if (distance <= radius) return std::nullopt;
  return makeCone(way / distance, std::asin(radius / distance));
}

Ball ballAroundBalls(std::span<const Ball> balls) {
  glm::dvec3 lower(1e300), upper(-1e300);
  for (const Ball& ball : balls) {
    lower = glm::min(lower, ball.centre - ball.radius);
    upper = glm::max(upper, ball.centre + ball.radius);
  }
  Ball around{0.5 * (lower + upper), 0.0};
  for (const Ball& ball : balls)
    around.radius = std::max(around.radius, glm::length(ball.centre - around.centre) + ball.radius);
  return around;
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
    const std::optional<Cone> aim = coneTowards(from, target);
    inside = inside || !aim;
    if (aim) aims.push_back(*aim);
  }
  const std::optional<Cone> all = coneTowards(from, ballAroundBalls(targets));
  const DirectionLattice lattice(map, side);
  std::vector<std::uint32_t> cells;
  for (std::uint32_t cell = 0; cell < side * side; ++cell) {
    bool meets = inside;
    for (std::size_t f = 0; f < frames.size() && !meets; ++f) {
      const Cone cone = lattice.cone(frames[f], cell);
      meets = (!all || meet(cone, *all)) &&
              std::any_of(aims.begin(), aims.end(), [&](const Cone& aim) { return meet(cone, aim); });
    }
    if (meets) cells.push_back(cell);
  }
  return cells;
}

}  // namespace prelight
