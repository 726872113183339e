#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "prelight/compiled_scene.h"

namespace prelight::viewer {

/// The surface of a scene as elements that occlude, and groups of them that stand for their elements where
/// they are far [1] (Real-Time Rendering, 4th edition, 11.3.5). Elements are pieces of triangles that
/// anything but light goes around: what is blended or glass is left out. [1] Bunnell, "Dynamic ambient
/// occlusion and indirect lighting", 2005.
class DiskTree {
 public:
  static constexpr std::size_t texelsOfNode = 4;
  static constexpr std::size_t mostPieces = 1 << 17;  ///< elements that triangles are cut for

  /// `size`: m, of the longest edge of an element; larger where that makes too many.
  DiskTree(const CompiledScene& scene, double size);

  /// Moves the elements to where the scene's vertices are now; all weights are 1 again.
  void refit(const CompiledScene& scene);

  std::size_t nodeCount() const { return nodes_.size(); }
  std::size_t elementCount() const { return (nodes_.size() + 1) / 2; }

  /// How much elements occlude: how open their backs are, 0 to 1, [node]; groups' are ignored. ([1] has backs
  /// occlude, and weighs them by how open their fronts are.) Two-sided elements always occlude in full.
  void setAccessibility(std::span<const float> accessibility);

  /// [node][texelsOfNode] as techniques/screen/disks/disks.glsl reads them; parents before children, which
  /// follow at once.
  std::vector<glm::vec4> texels() const;

 private:
  /// A piece of a triangle.
  struct Element {
    std::uint32_t triangle = 0;
    std::array<glm::vec3, 3> corners;  ///< barycentric
  };

  struct Node {
    std::uint32_t end = 0;      ///< the first node that is not within it
    std::uint32_t element = 0;  ///< of a leaf: end is its own number plus 1
    glm::vec3 centre{0.0f};
    float radius = 0.0f;
    glm::vec3 areaVector{0.0f};  ///< sum of areas x normals; of two-sided elements in groups 0
    float area = 0.0f;           ///< two-sided elements count twice in groups
    glm::mat3 tensor{0.0f};      ///< sum of areas x normal x normal; of a leaf its two edges from a corner
    float weight = 1.0f;
  };

  static void cut(const CompiledScene& scene, const Element& whole, double size, std::size_t most,
                  std::vector<Element>& pieces);
  void makeElements(const CompiledScene& scene, double size);
  void makeNodes(const CompiledScene& scene, std::span<std::uint32_t> order,
                 std::span<const glm::vec3> centres);
  std::array<glm::vec3, 3> placesOf(const CompiledScene& scene, const Element& element) const;
  bool isLeaf(std::size_t node) const { return nodes_[node].end == node + 1; }
  void fitLeaf(const CompiledScene& scene, Node& leaf) const;
  void fitGroup(std::size_t node);
  bool isTwoSided(const Node& leaf) const { return twoSided_[elements_[leaf.element].triangle]; }

  std::vector<Element> elements_;
  std::vector<Node> nodes_;
  std::vector<bool> twoSided_;  ///< [triangle]
};

}  // namespace prelight::viewer
