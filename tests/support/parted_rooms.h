#pragma once

#include <functional>
#include <glm/glm.hpp>

#include "prelight/compiled_scene.h"
#include "prelight/scene.h"

namespace prelight::test {

/// A closed box of 4 x 2 x 4 that a wall divides into a lit and a dark room. Floor, ceiling and side walls of
/// the box continue past the wall.
struct PartedRooms {
  CompiledScene scene;
  glm::dvec3 normal;    ///< Normal of the wall, towards the dark room.
  double beyond = 0.0;  ///< The dark room is where dot(normal, p) exceeds this.

  bool isDark(const glm::dvec3& p) const { return glm::dot(normal, p) > beyond; }
  Light lamp() const;  ///< A point light in the lit room.

  /// Calls visit(face, b1, b2, point) for places all over the fronts in the dark room, most of them near the
  /// wall.
  void forDarkPlaces(
      const std::function<void(std::uint32_t, double, double, const glm::dvec3&)>& visit) const;
};

/// `thickness` of the wall is 0 for a sheet; `turn` is its angle about the vertical in radians; `shift` moves
/// its middle along x. `cells` is the number of quads along each side of each face of the box.
PartedRooms partedRooms(double thickness, double turn = 0.0, double shift = 0.0, int cells = 4);

/// Two storeys: a slab divides a box of 4 x 4 x 4 at half its height, and the upper storey is dark.
PartedRooms partedStoreys(double thickness);

}  // namespace prelight::test
