#pragma once

#include <algorithm>
#include <cmath>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "prelight/compiled_scene.h"
#include "prelight/scene.h"

namespace prelight {

/// Returns true when the scene's pose draws a node's mesh in another shape than the file's: bent by a skin,
/// or with morph targets of weights other than 0.
bool isDeformed(const Scene& scene, const MeshNode& node);

/// The shapes that a scene's pose gives to its meshes.
struct Shapes {
  std::vector<std::vector<glm::dmat4>> joints;  ///< [skin][joint], Skin::toWorld
  std::vector<std::vector<float>> weights;      ///< [mesh node][morph target]

  bool operator==(const Shapes&) const = default;
};

/// Returns the shapes of the scene's present pose. Two poses with other shapes bend the surface.
Shapes shapesOf(const Scene& scene);

/// A mesh as a node's pose deforms it.
struct DeformedMesh {
  Mesh mesh;               ///< normals and tangents of length 1, or 0 where they vanish
  glm::dvec3 anchor{0.0};  ///< origin of the positions; with a skin a point near them, in world space
};

/// Returns the mesh with morph targets added, then bent by the skin (glTF 2.0, 3.7.2.2 and 3.7.3.3). Where a
/// skin mirrors most vertices of a primitive, its triangles are reversed, so that they still face outwards.
DeformedMesh deformedMesh(const Scene& scene, const MeshNode& node);

/// Returns the transform of a mesh's vertex to world space, given the matrices of its skin's joints.
glm::dmat4 blendedTransform(const Primitive& primitive, std::size_t vertex,
                            std::span<const glm::dmat4> jointsToWorld);

/// Returns the cofactors of the upper 3 x 3, which transform normals like the inverse transpose, even if a
/// scale of 0 leaves no inverse.
glm::dmat3 normalMatrix(const glm::dmat4& matrix);

/// Returns true when a transform changes handedness.
bool mirrors(const glm::dmat4& matrix);

/// Returns a vector of length 1, or 0 where there is no direction; components may be tiny.
inline glm::dvec3 unitOrZero(const glm::dvec3& vector) {
  const double largest = std::max({std::abs(vector.x), std::abs(vector.y), std::abs(vector.z)});
  if (!(largest > 0.0) || !std::isfinite(largest)) return glm::dvec3(0.0);
  return glm::normalize(vector / largest);
}

/// The meshes that a scene's nodes draw as they are posed.
class DrawnMeshes {
 public:
  /// `scene` must outlive this object.
  explicit DrawnMeshes(const Scene& scene);

  /// Returns the mesh of a mesh node, in a space of its own that transformOf() leads to world space.
  const Mesh& meshOf(std::size_t meshNode) const;
  /// Returns the transform from that space to world space.
  glm::dmat4 transformOf(std::size_t meshNode, std::size_t instance) const;
  /// Returns the number of a mesh node's shape. Mesh nodes of one number draw the same mesh with the same
  /// vertices: the number is that of the mesh, or beyond all meshes.
  int shapeOf(std::size_t meshNode) const { return shapes_[meshNode]; }

 private:
  const Scene& scene_;
  std::vector<int> shapes_;  ///< [mesh node]
  std::vector<DeformedMesh> deformed_;
};

/// Returns [vertex] a third of the area of the vertex' triangles, m2: the surface that the vertex represents.
std::vector<double> surfaceOfVertices(const CompiledScene& scene);

/// Returns surfaceOfVertices() with a tiny positive value for vertices without surface, so that all can be
/// used as weights.
std::vector<double> positiveSurfaceOfVertices(const CompiledScene& scene);

}  // namespace prelight
