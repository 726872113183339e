#pragma once

#include <array>
#include <cstddef>
#include <glm/glm.hpp>
#include <vector>

namespace prelight {

/// Places around an object, where planes across the three axes meet: close together where the object is, then
/// farther and farther apart.
class NeighbourhoodGrid {
 public:
  /// `halves`: of the object's bounds; `radius` of the ball around it.
  NeighbourhoodGrid(const glm::dvec3& centre, const glm::dvec3& halves, double radius);

  std::size_t count() const;
  glm::dvec3 placeOf(std::size_t index) const;

  struct Corner {
    std::size_t place = 0;
    double weight = 0.0;
  };

  /// What to interpolate at a point; one beyond all planes is drawn in, straight towards the centre.
  std::array<Corner, 8> cornersAt(const glm::dvec3& point) const;

 private:
  glm::dvec3 centre_;
  std::array<std::vector<double>, 3> planes_;  ///< [axis], ascending, from the centre
};

}  // namespace prelight
