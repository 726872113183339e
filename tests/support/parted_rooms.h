#pragma once

#include <functional>
#include <glm/glm.hpp>

#include "prelight/compiled_scene.h"
#include "prelight/scene.h"

namespace prelight::test {

/// A closed box of 4 x 2 x 4 whose floor, ceiling and side walls go on past a wall that parts it into a lit
/// room and a dark one.
struct PartedRooms {
  CompiledScene scene;
  glm::dvec3 normal;    ///< of the wall, towards the dark room
  double beyond = 0.0;  ///< the dark room is where dot(normal, p) exceeds this

  bool isDark(const glm::dvec3& p) const { return glm::dot(normal, p) > beyond; }
  Light lamp() const;  ///< a point light in the lit room

  /// Calls visit(face, b1, b2, point) for places all over the fronts in the dark room, most of them by the
  /// wall.
  void forDarkPlaces(
      const std::function<void(std::uint32_t, double, double, const glm::dvec3&)>& visit) const;
};

/// `thickness`: of the wall, 0: a sheet. `turn`: of the wall about the vertical, rad. `shift`: of its middle,
/// along x. `cells`: quads along each side of each face of the box.
PartedRooms partedRooms(double thickness, double turn = 0.0, double shift = 0.0, int cells = 4);

/// Two storeys: a slab parts a box of 4 x 4 x 4 at half its height, the upper storey is dark.
PartedRooms partedStoreys(double thickness);

}  // namespace prelight::test
