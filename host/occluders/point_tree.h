#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <glm/glm.hpp>
#include <span>
#include <vector>

namespace prelight {

/// A k-d tree of points, for searches by cost.
class PointTree {
 public:
  explicit PointTree(std::span<const glm::dvec3> points);

  /// What a point costs; infinity where it may not be taken. Never below `scale` x squared distance to the
  /// place of the search.
  using CostOf = std::function<double(std::uint32_t point)>;

  struct Found {
    std::uint32_t point = 0;
    double cost = 0.0;
  };

  /// The cheapest point of the first `most` that are looked at, nearby ones first; `best` where none is
  /// cheaper.
  Found cheapest(const glm::dvec3& place, double scale, const CostOf& costOf, Found best,
                 std::size_t most) const;

 private:
  struct Search;
  void split(std::size_t begin, std::size_t end);
  void visit(std::size_t begin, std::size_t end, Search& search) const;

  std::vector<glm::dvec3> points_;    ///< by place in the tree: the median of a range is its node
  std::vector<std::uint32_t> order_;  ///< parallel to points_, as they were given
  std::vector<std::uint8_t> axes_;    ///< parallel to points_, of a node's plane
};

}  // namespace prelight
