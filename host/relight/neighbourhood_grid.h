#pragma once

#include <array>
#include <cstddef>
#include <glm/glm.hpp>
#include <vector>

namespace prelight {

/// Places around an object at the crossings of planes perpendicular to the three axes: dense at the object,
/// then with increasing distances.
class NeighbourhoodGrid {
 public:
  /// `halves` are the half extents of the object's bounds; `radius` is that of its ball.
  NeighbourhoodGrid(const glm::dvec3& centre, const glm::dvec3& halves, double radius);

  std::size_t count() const;
  glm::dvec3 placeOf(std::size_t index) const;

  struct Corner {
    std::size_t place = 0;
    double weight = 0.0;
  };

  /// Returns the places and weights for interpolation at a point. Points beyond all planes are moved straight
  /// towards the centre.
  std::array<Corner, 8> cornersAt(const glm::dvec3& point) const;

 private:
  glm::dvec3 centre_;
  std::array<std::vector<double>, 3> planes_;  ///< [axis], ascending, relative to the centre
};

}  // namespace prelight
