#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <glm/glm.hpp>
#include <span>
#include <vector>

namespace prelight {

/// A k-d tree of points for searches by cost.
class PointTree {
 public:
  explicit PointTree(std::span<const glm::dvec3> points);

  /// Returns the cost of a point, infinity if it may not be chosen. It must never be below `scale` x squared
  /// distance to the place of the search.
  using CostOf = std::function<double(std::uint32_t point)>;

  struct Found {
    std::uint32_t point = 0;
    double cost = 0.0;
  };

  /// Returns the cheapest of the first `most` points visited, nearby ones first, or `best` if none is
  /// cheaper.
  Found cheapest(const glm::dvec3& place, double scale, const CostOf& costOf, Found best,
                 std::size_t most) const;

 private:
  struct Search;
  void split(std::size_t begin, std::size_t end);
  void visit(std::size_t begin, std::size_t end, Search& search) const;

  std::vector<glm::dvec3> points_;    ///< in tree order: the median of a range is its node
  std::vector<std::uint32_t> order_;  ///< parallel to points_, index in the original order
  std::vector<std::uint8_t> axes_;    ///< parallel to points_, axis of a node's plane
};

}  // namespace prelight
