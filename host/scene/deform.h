#pragma once

#include <algorithm>
#include <cmath>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "prelight/scene.h"

namespace prelight {

/// Whether the pose of a scene draws a node's mesh otherwise than the file has it: bent by a skin, or with
/// morph targets of weights other than 0.
bool isDeformed(const Scene& scene, const MeshNode& node);

/// A mesh as a node's pose has it.
struct DeformedMesh {
  Mesh mesh;               ///< normals and tangents of length 1, or 0 where nothing is left of them
  glm::dvec3 anchor{0.0};  ///< what positions are relative to: with a skin a place near them, in world space
};

/// Morph targets added, then bent by the skin (glTF 2.0, 3.7.2.2 and 3.7.3.3). Where a skin mirrors most
/// vertices of a primitive its triangles go round the other way, so that they face outwards still.
DeformedMesh deformedMesh(const Scene& scene, const MeshNode& node);

/// From a vertex of a mesh to world space, by the matrices of its skin's joints.
glm::dmat4 blendedTransform(const Primitive& primitive, std::size_t vertex,
                            std::span<const glm::dmat4> jointsToWorld);

/// Cofactors of the upper 3 x 3 which turn normals as the inverse transpose does, and still do where a scale
/// of 0 leaves no inverse.
glm::dmat3 normalMatrix(const glm::dmat4& matrix);

/// Whether a transform turns a right hand into a left one.
bool mirrors(const glm::dmat4& matrix);

/// A vector of length 1, or 0 where there is no direction; components may be tiny.
inline glm::dvec3 unitOrZero(const glm::dvec3& vector) {
  const double largest = std::max({std::abs(vector.x), std::abs(vector.y), std::abs(vector.z)});
  if (!(largest > 0.0) || !std::isfinite(largest)) return glm::dvec3(0.0);
  return glm::normalize(vector / largest);
}

/// The meshes that a scene's nodes draw as they are posed.
class DrawnMeshes {
 public:
  /// The scene outlives it.
  explicit DrawnMeshes(const Scene& scene);

  /// A mesh node's. In a space of its own: transformOf() leads out of it.
  const Mesh& meshOf(std::size_t meshNode) const;
  /// From those positions to world space.
  glm::dmat4 transformOf(std::size_t meshNode, std::size_t instance) const;
  /// Mesh nodes of one number draw the same mesh with the same vertices: the mesh's own, or one beyond all
  /// of them.
  int shapeOf(std::size_t meshNode) const { return shapes_[meshNode]; }

 private:
  const Scene& scene_;
  std::vector<int> shapes_;  ///< [mesh node]
  std::vector<DeformedMesh> deformed_;
};

}  // namespace prelight
