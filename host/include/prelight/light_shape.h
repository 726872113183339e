#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

namespace prelight {

enum class ShapeKind : std::uint8_t { Sphere, Disk, Polygon };

/// Shape of an area light, which emits the same radiance everywhere and in all directions.
struct LightShape {
  ShapeKind kind = ShapeKind::Sphere;
  double radius = 0.0;  ///< m, > 0; for spheres and disks
  /// Polygons only: corners in m along the light's side and along cross(direction, side), relative to its
  /// position. The polygon is convex, has at least three corners, and is counter-clockwise seen from the side
  /// that it shines to.
  std::vector<glm::dvec2> corners = {};
  bool twoSided = false;  ///< whether a flat shape shines from both sides

  bool operator==(const LightShape&) const = default;
};

}  // namespace prelight
