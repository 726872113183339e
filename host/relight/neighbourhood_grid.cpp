#include "relight/neighbourhood_grid.h"

#include <algorithm>
#include <cmath>

namespace prelight {

namespace {

/// Positions of planes: within the object relative to its half extent, and beyond it in radii of its ball.
constexpr std::array<double, 2> sharesWithin = {0.4, 0.8};
constexpr std::array<double, 8> beyond = {0.03, 0.18, 0.4, 0.75, 1.3, 2.2, 3.8, 6.5};

std::vector<double> planesOf(double half, double radius) {
  std::vector<double> above;
  for (const double share : sharesWithin) above.push_back(share * half);
  for (const double more : beyond) above.push_back(half + more * radius);
  std::vector<double> planes;
  for (auto plane = above.rbegin(); plane != above.rend(); ++plane) planes.push_back(-*plane);
  planes.push_back(0.0);
  planes.insert(planes.end(), above.begin(), above.end());
  return planes;
}

}  // namespace

NeighbourhoodGrid::NeighbourhoodGrid(const glm::dvec3& centre, const glm::dvec3& halves, double radius)
    : centre_(centre) {
  // Flat objects have planes within them, too.
  for (int a = 0; a < 3; ++a)
    planes_[static_cast<std::size_t>(a)] = planesOf(std::max(halves[a], 0.01 * radius), radius);
}

std::size_t NeighbourhoodGrid::count() const {
  return planes_[0].size() * planes_[1].size() * planes_[2].size();
}

glm::dvec3 NeighbourhoodGrid::placeOf(std::size_t index) const {
  const std::size_t x = planes_[0].size(), y = planes_[1].size();
  return centre_ + glm::dvec3(planes_[0][index % x], planes_[1][index / x % y], planes_[2][index / (x * y)]);
}

std::array<NeighbourhoodGrid::Corner, 8> NeighbourhoodGrid::cornersAt(const glm::dvec3& point) const {
  glm::dvec3 from = point - centre_;
  double shrink = 1.0;
  for (std::size_t a = 0; a < 3; ++a)
    shrink = std::min(shrink, planes_[a].back() / std::max(std::abs(from[static_cast<int>(a)]), 1e-300));
  from *= shrink;
  std::array<std::size_t, 3> first{};
  std::array<double, 3> share{};
  for (std::size_t a = 0; a < 3; ++a) {
    const std::vector<double>& planes = planes_[a];
    const double at = from[static_cast<int>(a)];
    const auto next = std::upper_bound(planes.begin() + 1, planes.end() - 1, at);
    first[a] = static_cast<std::size_t>(next - planes.begin()) - 1;
    share[a] = std::clamp((at - *(next - 1)) / (*next - *(next - 1)), 0.0, 1.0);
  }
  std::array<Corner, 8> corners;
  for (std::size_t k = 0; k < 8; ++k) {
    Corner& corner = corners[k];
    corner.weight = 1.0;
    for (std::size_t a = 3; a-- > 0;) {
      const std::size_t step = k >> a & 1;
      corner.weight *= step == 1 ? share[a] : 1.0 - share[a];
      corner.place = corner.place * planes_[a].size() + first[a] + step;
    }
  }
  return corners;
}

}  // namespace prelight
