#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

namespace prelight {

enum class ShapeKind : std::uint8_t { Sphere, Disk, Polygon };

/// What an area light shines from: everywhere and in all directions with the same radiance.
struct LightShape {
  ShapeKind kind = ShapeKind::Sphere;
  double radius = 0.0;  ///< m, of spheres and disks, > 0
  /// Of polygons, m: along the light's side and along cross(direction, side), from its position. Convex, at
  /// least three, counter-clockwise seen from where they shine to.
  std::vector<glm::dvec2> corners = {};
  bool twoSided = false;  ///< of what is flat

  bool operator==(const LightShape&) const = default;
};

}  // namespace prelight
