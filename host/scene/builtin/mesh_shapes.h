#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

namespace prelight {

/// An indexed triangle mesh with unit normals; front faces counter-clockwise.
struct MeshShape {
  std::vector<glm::vec3> positions;
  std::vector<glm::vec3> normals;
  std::vector<glm::uvec3> triangles;
  std::vector<glm::vec2> texCoords = {};  ///< (0, 0) is at the end of edgeV in grids; empty: none

  /// Moves texture coordinates from the unit square to a rectangle.
  void placeTexCoords(const glm::vec2& corner, const glm::vec2& size);

  /// Appends another shape without merging vertices.
  void add(const MeshShape& other);
};

/// Returns a rectangle from `corner` along two edges, cut into columns x rows quads; its front faces along
/// cross(edgeU, edgeV). Grids that meet get exactly the same vertices where theirs coincide.
MeshShape makeGrid(const glm::dvec3& corner, const glm::dvec3& edgeU, const glm::dvec3& edgeV, int columns,
                   int rows);

/// Returns a box standing on y = 0 around the y axis, facing outwards, with hard edges and cells x cells
/// quads per face. Texture coordinates lay the faces out in three columns and two rows, with gaps.
MeshShape makeBox(const glm::dvec3& size, int cells, bool withBottom);

/// A point of the outline of a surface of revolution around the y axis, and the outline's normal there.
struct OutlinePoint {
  float radius;
  float height;
  glm::vec2 normal;  ///< (radial, y), unit
};

/// Sweeps an outline around the y axis. The outline runs so that its outside lies to the right when it goes
/// up (+y). A point on the axis becomes one vertex if its normal lies along the axis, otherwise one per
/// segment.
MeshShape makeLathe(const std::vector<OutlinePoint>& outline, int segments);

/// These return closed shapes that stand on y = 0 around the y axis.
MeshShape makeSphere(float radius, int segments, int rings);
MeshShape makeTorus(float ringRadius, float tubeRadius, int segments, int tubeSegments);
MeshShape makeCone(float radius, float height, int segments, int rows, int discRings);
MeshShape makeCylinder(float radius, float height, int segments, int rows, int discRings);

}  // namespace prelight
