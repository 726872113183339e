#pragma once

#include <cstdint>
#include <vector>

#include "occluders/rigid_motion.h"
#include "prelight/compiled_scene.h"
#include "prelight/scene.h"

namespace prelight {

/// What is no longer where it was.
struct SceneChange {
  std::vector<std::uint32_t> triangles;  ///< in ascending order
  std::vector<std::uint32_t> lights;     ///< punctual ones, in ascending order
  bool sky = false;                      ///< it has turned
  bool empty() const { return triangles.empty() && lights.empty() && !sky; }
};

/// Whether one scene in two poses has the same triangles, shared by the same drawings. It has not where a
/// node is flat in one of them, is turned inside out, or bends a mesh that others share.
bool haveSameTriangles(const CompiledScene& a, const CompiledScene& b);

/// A compiled scene whose nodes move and whose lights are changed, in its own coordinates:
/// origin, vertex order and triangles stay what they were, so that all that does not move keeps its numbers
/// to the last bit.
class LiveScene {
 public:
  LiveScene(const Scene& scene, CompiledScene compiled);

  const CompiledScene& compiled() const { return compiled_; }

  /// Puts a node with all that hangs on it, punctual lights too, where `motion` takes it from its place in
  /// the file; world space. Motions of nodes above one another do not add up: the last one counts. Throws
  /// UsageError where nothing that is drawn or shines hangs on the node.
  void moveNode(int node, const RigidMotion& motion);

  /// Puts all vertices where another pose of the scene has them, of the same origin and the same triangles;
  /// motions are from there on. Lights stay. Throws UsageError.
  void pose(const CompiledScene& posed);

  /// Replaces a punctual light, of the same type. Throws UsageError.
  void setLight(std::size_t index, const Light& light);

  /// Triangles that hang on a node, in ascending order.
  std::vector<std::uint32_t> trianglesOf(int node) const;

  /// What has changed since the last call.
  SceneChange takeChanges();

  /// Widens the bounds where something has left the ball around them, which light from afar covers. True:
  /// they are others now.
  bool growBounds();

 private:
  std::vector<std::uint8_t> hangsOn(int node) const;
  void moveInstance(std::uint32_t firstTriangle, const RigidMotion& motion);
  void posePrimitive(const PrimitiveRange& range, const CompiledScene& posed);

  std::vector<SceneNode> nodes_;
  std::vector<std::size_t> primitiveNodes_;  ///< [primitive], into nodes_
  CompiledScene compiled_;
  std::vector<CompiledInstance> restInstances_;
  std::vector<glm::vec3> restPositions_, restNormals_;
  std::vector<Light> restLights_;
  std::vector<std::size_t> lightNodes_;    ///< [light], into nodes_, or their number: none
  std::vector<RigidMotion> lightMotions_;  ///< [light] that its node has made
  SceneChange changes_;
};

}  // namespace prelight
