#include "viewer/techniques/screen/disks/disk_tree.h"

#include <algorithm>
#include <numeric>

#include "viewer/scene/occluding_material.h"

namespace prelight::viewer {
namespace {

constexpr double growth = 1.5;  ///< of elements that were too many

glm::mat3 outer(const glm::vec3& v) { return glm::outerProduct(v, v); }

}  // namespace

DiskTree::DiskTree(const CompiledScene& scene, double size) {
  twoSided_.resize(scene.triangleCount());
  for (std::uint32_t t = 0; t < scene.triangleCount(); ++t)
    twoSided_[t] = scene.materials[scene.triangleMaterials[t]].doubleSided;
  makeElements(scene, size);
  std::vector<glm::vec3> centres;
  for (const Element& element : elements_) {
    const auto [a, b, c] = placesOf(scene, element);
    centres.push_back((a + b + c) / 3.0f);
  }
  std::vector<std::uint32_t> order(elements_.size());
  std::iota(order.begin(), order.end(), 0u);
  nodes_.reserve(2 * elements_.size());
  if (!order.empty()) makeNodes(scene, order, centres);
  refit(scene);
}

std::array<glm::vec3, 3> DiskTree::placesOf(const CompiledScene& scene, const Element& element) const {
  const glm::uvec3& corners = scene.triangles[element.triangle];
  const glm::mat3 triangle(scene.positions[corners[0]], scene.positions[corners[1]],
                           scene.positions[corners[2]]);
  return {triangle * element.corners[0], triangle * element.corners[1], triangle * element.corners[2]};
}

/// Halves the longest edge until none is longer than `size`, or there are too many pieces.
void DiskTree::cut(const CompiledScene& scene, const Element& whole, double size, std::size_t most,
                   std::vector<Element>& pieces) {
  const glm::uvec3& corners = scene.triangles[whole.triangle];
  const glm::mat3 triangle(scene.positions[corners[0]], scene.positions[corners[1]],
                           scene.positions[corners[2]]);
  std::vector<Element> open = {whole};
  while (!open.empty()) {
    const Element piece = open.back();
    open.pop_back();
    int longest = 0;
    float length = -1.0f;
    for (int k = 0; k < 3; ++k) {
      const float edge = glm::length(triangle * (piece.corners[(k + 1) % 3] - piece.corners[k]));
      if (edge > length) longest = k, length = edge;
    }
    if (length <= size || pieces.size() + open.size() >= most) {
      pieces.push_back(piece);
      continue;
    }
    const int next = (longest + 1) % 3;
    const glm::vec3 middle = 0.5f * (piece.corners[longest] + piece.corners[next]);
    Element first = piece, second = piece;
    first.corners[next] = middle;
    second.corners[longest] = middle;
    open.push_back(first);
    open.push_back(second);
  }
}

void DiskTree::makeElements(const CompiledScene& scene, double size) {
  std::vector<Element> whole;
  for (std::uint32_t t = 0; t < scene.triangleCount(); ++t)
    if (occludes(scene.materials[scene.triangleMaterials[t]]))
      whole.push_back({t, {glm::vec3(1, 0, 0), glm::vec3(0, 1, 0), glm::vec3(0, 0, 1)}});
  elements_ = whole;
  for (; whole.size() < mostPieces; size *= growth) {
    elements_.clear();
    for (const Element& element : whole) cut(scene, element, size, mostPieces, elements_);
    if (elements_.size() < mostPieces) return;
  }
}

/// The node of some elements, and those within it: halves along the longest side of the box of their centres.
void DiskTree::makeNodes(const CompiledScene& scene, std::span<std::uint32_t> order,
                         std::span<const glm::vec3> centres) {
  const std::size_t node = nodes_.size();
  nodes_.push_back({.end = static_cast<std::uint32_t>(node + 2 * order.size() - 1), .element = order[0]});
  if (order.size() == 1) return;
  glm::vec3 lower = centres[order[0]], upper = lower;
  for (const std::uint32_t e : order) {
    lower = glm::min(lower, centres[e]);
    upper = glm::max(upper, centres[e]);
  }
  const glm::vec3 sides = upper - lower;
  const int axis = sides.x >= sides.y && sides.x >= sides.z ? 0 : sides.y >= sides.z ? 1 : 2;
  const std::size_t half = order.size() / 2;
  std::nth_element(order.begin(), order.begin() + static_cast<std::ptrdiff_t>(half), order.end(),
                   [&](std::uint32_t a, std::uint32_t b) {
                     return std::pair(centres[a][axis], a) < std::pair(centres[b][axis], b);
                   });
  makeNodes(scene, order.first(half), centres);
  makeNodes(scene, order.subspan(half), centres);
}

void DiskTree::fitLeaf(const CompiledScene& scene, Node& leaf) const {
  const auto [a, b, c] = placesOf(scene, elements_[leaf.element]);
  leaf.centre = (a + b + c) / 3.0f;
  leaf.radius =
      std::max({glm::length(a - leaf.centre), glm::length(b - leaf.centre), glm::length(c - leaf.centre)});
  leaf.areaVector = 0.5f * glm::cross(b - a, c - a);
  leaf.area = glm::length(leaf.areaVector);
  leaf.tensor[0] = b - a;
  leaf.tensor[1] = c - a;
}

void DiskTree::fitGroup(std::size_t node) {
  Node& group = nodes_[node];
  const std::size_t children[] = {node + 1, nodes_[node + 1].end};
  group.areaVector = glm::vec3(0.0f);
  group.tensor = glm::mat3(0.0f);
  group.area = 0.0f;
  float occluding = 0.0f;
  glm::vec3 centre(0.0f);
  for (const std::size_t child : children) {
    const Node& part = nodes_[child];
    const bool twoSided = isLeaf(child) && isTwoSided(part);
    const float area = (twoSided ? 2.0f : 1.0f) * part.area;
    if (!twoSided) group.areaVector += part.areaVector;
    group.tensor += isLeaf(child) ? outer(part.areaVector) * (area / std::max(part.area * part.area, 1e-30f))
                                  : part.tensor;
    group.area += area;
    occluding += area * part.weight;
    centre += area * part.centre;
  }
  group.centre = group.area > 0.0f ? centre / group.area
                                   : 0.5f * (nodes_[children[0]].centre + nodes_[children[1]].centre);
  group.weight = group.area > 0.0f ? occluding / group.area : 0.0f;
  group.radius = 0.0f;
  for (const std::size_t child : children)
    group.radius =
        std::max(group.radius, glm::length(nodes_[child].centre - group.centre) + nodes_[child].radius);
}

void DiskTree::refit(const CompiledScene& scene) {
  for (std::size_t node = nodes_.size(); node-- > 0;) {
    nodes_[node].weight = 1.0f;
    if (isLeaf(node))
      fitLeaf(scene, nodes_[node]);
    else
      fitGroup(node);
  }
}

void DiskTree::setAccessibility(std::span<const float> accessibility) {
  for (std::size_t node = nodes_.size(); node-- > 0;) {
    if (!isLeaf(node))
      fitGroup(node);
    else if (!isTwoSided(nodes_[node]))
      nodes_[node].weight = accessibility[node];
  }
}

std::vector<glm::vec4> DiskTree::texels() const {
  std::vector<glm::vec4> texels;
  texels.reserve(texelsOfNode * nodes_.size());
  for (std::size_t i = 0; i < nodes_.size(); ++i) {
    const Node& node = nodes_[i];
    const glm::mat3& t = node.tensor;
    const bool leaf = isLeaf(i);
    texels.emplace_back(node.centre, node.radius);
    texels.emplace_back(node.areaVector, leaf && isTwoSided(node) ? -node.area : node.area);
    texels.emplace_back(leaf ? t[0] : glm::vec3(t[0][0], t[1][1], t[2][2]), node.weight);
    texels.emplace_back(leaf ? t[1] : glm::vec3(t[0][1], t[0][2], t[1][2]),
                        leaf ? -1.0f : static_cast<float>(node.end));
  }
  return texels;
}

}  // namespace prelight::viewer
