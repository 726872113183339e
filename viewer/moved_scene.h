#pragma once

#include <cstddef>
#include <glm/glm.hpp>
#include <span>
#include <string>
#include <vector>

#include "gi/update/live_scene.h"
#include "viewer/light_follower.h"

namespace prelight::viewer {

/// A scene whose nodes are dragged about.
class MovedScene {
 public:
  /// A node with triangles.
  struct Node {
    int node = 0;            ///< index in the glTF file
    std::string name;        ///< "node N" where the file has none
    glm::dvec3 center{0.0};  ///< middle of its bounds at rest, world space
  };

  /// `fixed`: a node that is not dragged, -1: none.
  MovedScene(const Scene& scene, const CompiledScene& compiled, int fixed = -1);

  const CompiledScene& scene() const { return scene_.compiled(); }
  const std::vector<Node>& nodes() const { return nodes_; }
  std::span<const NodeShift> shifts() const { return shifts_; }

  /// Takes every node from where the file has it by a way, m, in the order of nodes(). True when something
  /// has moved since the last call.
  bool move(std::span<const glm::dvec3> ways);

 private:
  LiveScene scene_;
  std::vector<Node> nodes_;
  std::vector<NodeShift> shifts_;
};

}  // namespace prelight::viewer
