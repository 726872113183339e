#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "scene/builtin/mesh_shapes.h"

namespace prelight {

/// Texture coordinates of these shapes are in metres along the surface, unless a function says otherwise.

/// A box with rounded edges, centred at the origin.
struct RoundedBox {
  glm::dvec3 size;        ///< m
  double radius = 0.004;  ///< of the edges, m; less than half of the smallest side
  int arcs = 1;           ///< segments along half of each rounded edge
  double cell = 0.1;      ///< longest side of a quad on the flat parts, m
};

/// Returns the box, which is closed. On each face u runs along the longer side, as grain does in wood.
MeshShape makeRoundedBox(const RoundedBox& box);

/// Returns points on a smooth curve (Catmull-Rom) through the given ones, `steps` per piece.
std::vector<glm::dvec2> smoothCurve(const std::vector<glm::dvec2>& points, int steps);

/// Sweeps a profile of (radius, height) around the y axis; its outside lies to the right when it goes up.
/// Bends of more than 40 degrees stay sharp. u runs once around, v along the profile from 0 to 1.
MeshShape makeTurned(const std::vector<glm::dvec2>& profile, int segments);

/// A point of a branch and the branch's radius there.
struct BranchPoint {
  glm::dvec3 position;
  double radius;
};

/// Returns a tube along the points, open at both ends.
MeshShape makeBranch(const std::vector<BranchPoint>& points, int segments);

/// Returns a pillow of the given width, height and greatest thickness, centred at the origin in the xy plane.
MeshShape makePillow(const glm::dvec3& size, int cells);

/// Returns a sheet that hangs in folds along x, centred at x = 0, from y = 0 up to `height`. Its front faces
/// +z.
MeshShape makeCurtain(double width, double height, double depth, int folds);

/// Rotates a shape by a matrix, then moves it.
void place(MeshShape& shape, const glm::dmat3& rotation, const glm::dvec3& translation);
void place(MeshShape& shape, const glm::dvec3& translation);

/// Divides texture coordinates by the side of a texture in metres and shifts them.
void fitTexCoords(MeshShape& shape, double side, const glm::dvec2& shift = glm::dvec2(0.0));

/// Returns the rotation by an angle in radians around an axis.
glm::dmat3 rotationAbout(const glm::dvec3& axis, double angle);

}  // namespace prelight
