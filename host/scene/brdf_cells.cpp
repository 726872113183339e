#include "scene/brdf_cells.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "prelight/measured_brdf.h"

namespace prelight {

namespace {

using std::numbers::pi;

/// Two neighbouring indices along one of the angles, and the position between them.
struct Neighbours {
  int first = 0, second = 0;
  double share = 0.0;
};

Neighbours between(double place, int count) {
  const double clamped = std::clamp(place - 0.5, 0.0, count - 1.0);
  const int first = std::min(static_cast<int>(clamped), count - 2);
  return {first, first + 1, clamped - first};
}

/// Returns the neighbours of a place on a circle: the last index is next to the first.
Neighbours around(double place, int count) {
  const double shifted = place - 0.5 + count;
  const int first = static_cast<int>(shifted);
  return {first % count, (first + 1) % count, shifted - first};
}

}  // namespace

std::size_t brdfCell(int half, int difference, int turn) {
  return (static_cast<std::size_t>(half) * MeasuredBrdf::differences + static_cast<std::size_t>(difference)) *
             MeasuredBrdf::turns +
         static_cast<std::size_t>(turn);
}

glm::dvec3 brdfAt(std::span<const glm::vec3> cells, const glm::dvec3& wo, const glm::dvec3& wi) {
  const glm::dvec3 h = glm::normalize(wo + wi);
  const double across = std::hypot(h.x, h.y);
  const glm::dvec2 way = across > 1e-9 ? glm::dvec2(h) / across : glm::dvec2(1.0, 0.0);
  // wi in the frame of the half vector.
  const double x = h.z * (wi.x * way.x + wi.y * way.y) - across * wi.z, y = wi.y * way.x - wi.x * way.y,
               z = glm::dot(wi, h);
  const double half = std::sqrt(std::clamp(std::atan2(across, h.z) * 2.0 / pi, 0.0, 1.0));
  const double turn = std::atan2(y, x) / pi;
  const Neighbours a = between(half * MeasuredBrdf::halves, MeasuredBrdf::halves);
  const Neighbours b = between(std::atan2(std::hypot(x, y), z) * 2.0 / pi * MeasuredBrdf::differences,
                               MeasuredBrdf::differences);
  const Neighbours c = around((turn - std::floor(turn)) * MeasuredBrdf::turns, MeasuredBrdf::turns);
  const auto alongTurn = [&](int i, int j) {
    return glm::mix(glm::dvec3(cells[brdfCell(i, j, c.first)]), glm::dvec3(cells[brdfCell(i, j, c.second)]),
                    c.share);
  };
  const auto alongDifference = [&](int i) {
    return glm::mix(alongTurn(i, b.first), alongTurn(i, b.second), b.share);
  };
  return glm::mix(alongDifference(a.first), alongDifference(a.second), a.share);
}

glm::dvec2 cosinesOfCell(int half, int difference, int turn) {
  const double root = (half + 0.5) / MeasuredBrdf::halves, theta = 0.5 * pi * root * root;
  const double apart = 0.5 * pi * (difference + 0.5) / MeasuredBrdf::differences;
  const double azimuth = pi * (turn + 0.5) / MeasuredBrdf::turns;
  const double along = std::cos(theta) * std::cos(apart);
  const double across = std::sin(theta) * std::sin(apart) * std::cos(azimuth);
  return {along + across, along - across};
}

}  // namespace prelight
