#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "gpu/transport_scene.h"
#include "occluders/rigid_motion.h"
#include "prelight/compiled_scene.h"
#include "prelight/scene.h"

namespace prelight {

/// Parts of a scene that have changed.
struct SceneChange {
  std::vector<std::uint32_t> triangles;  ///< moved triangles, ascending
  std::vector<std::uint32_t> lights;     ///< changed punctual lights, ascending
  bool sky = false;                      ///< whether the sky has turned
  bool empty() const { return triangles.empty() && lights.empty() && !sky; }
};

/// Returns whether two poses of a scene have equal triangles, shared by the same instances. They differ if in
/// one pose a node is flat, turned inside out, or bends a mesh that others share.
bool haveSameTriangles(const CompiledScene& a, const CompiledScene& b);

/// A compiled scene whose nodes move and whose lights change. Origin, vertex order and triangles stay the
/// same, so that everything that does not move keeps its numbers bit for bit.
class LiveScene {
 public:
  LiveScene(const Scene& scene, CompiledScene compiled);

  const CompiledScene& compiled() const { return compiled_; }

  /// Moves a node with its descendants, including punctual lights, by `motion` from its place in the file;
  /// world space. Motions of ancestors and descendants are not combined: the last call counts. Throws
  /// UsageError for a node without meshes and lights.
  void moveNode(int node, const RigidMotion& motion);

  /// Moves all vertices to another pose of the scene with equal origin and triangles. Later motions start
  /// from there. Lights stay. Throws UsageError.
  void pose(const CompiledScene& posed);

  /// Replaces a punctual light by one of the same type. Throws UsageError.
  void setLight(std::size_t index, const Light& light);

  /// Returns the triangles of a node and its descendants, ascending.
  std::vector<std::uint32_t> trianglesOf(int node) const;

  /// Returns the changes since the last call.
  SceneChange takeChanges();

  /// Extends the bounds if anything has left their bounding ball, which distant light covers. Returns whether
  /// they have changed.
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
  std::vector<std::size_t> lightNodes_;  ///< [light], into nodes_; their number if no node carries the light
  std::vector<RigidMotion> lightMotions_;  ///< [light], motion by its node
  SceneChange changes_;
};

/// Moving triangles, which are kept in a separate tree.
class MovingTriangles {
 public:
  /// Adds triangles, and rebuilds their tree if any is new.
  void add(const CompiledScene& compiled, TransportScene& transport,
           std::span<const std::uint32_t> triangles);

 private:
  std::vector<std::uint32_t> separated_;  ///< ascending
};

/// Applies a change to the scene on the device. Returns true if stored light must be discarded, because
/// lights of a kind that the programs were not built for are on now.
bool followChange(const SceneChange& change, LiveScene& scene, MovingTriangles& moving,
                  TransportScene& transport);

}  // namespace prelight
