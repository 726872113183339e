#include "viewer/moved_scene.h"

#include <algorithm>
#include <limits>
#include <map>

namespace prelight::viewer {
namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();

struct Bounds {
  std::string name;
  glm::dvec3 lower{infinite};
  glm::dvec3 upper{-infinite};
};

}  // namespace

MovedScene::MovedScene(const Scene& scene, const CompiledScene& compiled, int fixed)
    : scene_(scene, compiled) {
  std::map<int, Bounds> bounds;
  for (const PrimitiveRange& range : compiled.primitives) {
    if (range.triangleCount == 0 || range.node == fixed) continue;
    Bounds& node = bounds[range.node];
    node.name = range.name.empty() ? "node " + std::to_string(range.node) : range.name;
    for (std::uint32_t v = range.firstVertex; v < range.firstVertex + range.vertexCount; ++v) {
      node.lower = glm::min(node.lower, glm::dvec3(compiled.positions[v]));
      node.upper = glm::max(node.upper, glm::dvec3(compiled.positions[v]));
    }
  }
  for (const auto& [node, box] : bounds) {
    nodes_.push_back({node, box.name, compiled.origin + 0.5 * (box.lower + box.upper)});
    shifts_.push_back({node, glm::dvec3(0.0)});
  }
}

bool MovedScene::move(std::span<const glm::dvec3> ways) {
  bool moved = false;
  for (std::size_t i = 0; i < std::min(ways.size(), shifts_.size()); ++i) {
    if (ways[i] == shifts_[i].by) continue;
    shifts_[i].by = ways[i];
    scene_.moveNode(shifts_[i].node, {glm::dmat3(1.0), ways[i]});
    moved = true;
  }
  if (!moved) return false;
  scene_.growBounds();
  scene_.takeChanges();  // who follows is told of shifts
  return true;
}

}  // namespace prelight::viewer
