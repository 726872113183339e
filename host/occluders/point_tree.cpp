#include "occluders/point_tree.h"

#include <algorithm>
#include <numeric>

namespace prelight {

struct PointTree::Search {
  const glm::dvec3& place;
  double scale;
  const CostOf& costOf;
  Found best;
  std::size_t left;  ///< points that may still be visited
};

PointTree::PointTree(std::span<const glm::dvec3> points)
    : points_(points.begin(), points.end()), order_(points.size()), axes_(points.size(), 0) {
  std::iota(order_.begin(), order_.end(), 0u);
  split(0, points_.size());
  std::vector<glm::dvec3> sorted(points_.size());
  for (std::size_t i = 0; i < order_.size(); ++i) sorted[i] = points_[order_[i]];
  points_ = std::move(sorted);
}

void PointTree::split(std::size_t begin, std::size_t end) {
  if (end - begin < 2) return;
  glm::dvec3 low = points_[order_[begin]], high = low;
  for (std::size_t i = begin; i < end; ++i) {
    low = glm::min(low, points_[order_[i]]);
    high = glm::max(high, points_[order_[i]]);
  }
  const glm::dvec3 size = high - low;
  const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
  const std::size_t middle = (begin + end) / 2;
  const auto at = [&](std::size_t i) { return order_.begin() + static_cast<std::ptrdiff_t>(i); };
  std::nth_element(at(begin), at(middle), at(end), [&](std::uint32_t a, std::uint32_t b) {
    return points_[a][axis] != points_[b][axis] ? points_[a][axis] < points_[b][axis] : a < b;
  });
  axes_[middle] = static_cast<std::uint8_t>(axis);
  split(begin, middle);
  split(middle + 1, end);
}

void PointTree::visit(std::size_t begin, std::size_t end, Search& search) const {
  if (begin == end || search.left == 0) return;
  const std::size_t middle = (begin + end) / 2;
  const glm::dvec3 path = search.place - points_[middle];
  const double beyond = path[axes_[middle]];
  const bool below = beyond <= 0.0;
  visit(below ? begin : middle + 1, below ? middle : end, search);
  if (search.left > 0 && search.scale * glm::dot(path, path) < search.best.cost) {
    --search.left;
    const double cost = search.costOf(order_[middle]);
    if (cost < search.best.cost) search.best = {order_[middle], cost};
  }
  if (search.scale * beyond * beyond < search.best.cost)
    visit(below ? middle + 1 : begin, below ? end : middle, search);
}

PointTree::Found PointTree::cheapest(const glm::dvec3& place, double scale, const CostOf& costOf, Found best,
                                     std::size_t most) const {
  Search search{place, scale, costOf, best, most};
  visit(0, points_.size(), search);
  return search.best;
}

}  // namespace prelight
