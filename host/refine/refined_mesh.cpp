#include "refine/refined_mesh.h"

#include <algorithm>
#include <cstring>
#include <map>
#include <tuple>

namespace prelight {

namespace {

std::uint64_t keyOf(std::uint32_t a, std::uint32_t b) {
  return std::uint64_t{std::min(a, b)} << 32 | std::max(a, b);
}

}  // namespace

glm::uvec3 fileTriangle(const Primitive& primitive, std::size_t triangle) {
  glm::uvec3 corners = primitive.triangles[triangle];
  if (!primitive.turns.empty() && (primitive.turns[triangle] & CornersExchanged) != 0)
    std::swap(corners.y, corners.z);
  return corners;
}

RefinedMesh::RefinedMesh(const Mesh& mesh, std::size_t index, const glm::dmat3& toWorld)
    : index_(index), toWorld_(toWorld) {
  std::map<std::tuple<float, float, float>, std::uint32_t> welded;
  for (std::uint32_t p = 0; p < mesh.primitives.size(); ++p) {
    const Primitive& primitive = mesh.primitives[p];
    Vertices& vertices = vertices_.emplace_back();
    vertices.originals = primitive.positions.size();
    for (const glm::vec3& v : primitive.positions) {
      const auto [found, fresh] =
          welded.try_emplace({v.x, v.y, v.z}, static_cast<std::uint32_t>(positions_.size()));
      if (fresh) positions_.push_back(v);
      vertices.welded.push_back(found->second);
    }
    for (std::uint32_t t = 0; t < primitive.triangles.size(); ++t) {
      const glm::uvec3 corners = fileTriangle(primitive, t);
      parts_.push_back({p, t, {corners.x, corners.y, corners.z}, {{{0.0, 0.0}, {1.0, 0.0}, {0.0, 1.0}}}});
    }
  }
  listUses();
}

void RefinedMesh::listUses() {
  uses_.clear();
  uses_.reserve(3 * parts_.size());
  for (std::uint32_t p = 0; p < parts_.size(); ++p)
    for (std::uint8_t from = 0; from < 3; ++from) uses_.push_back({edgeOf(parts_[p], from), p, from});
  std::sort(uses_.begin(), uses_.end(), [](const EdgeUse& a, const EdgeUse& b) {
    return std::tie(a.edge, a.part, a.from) < std::tie(b.edge, b.part, b.from);
  });
}

/// Returns the parts with an edge.
std::span<const RefinedMesh::EdgeUse> RefinedMesh::usesOf(Edge edge) const {
  const auto begin = std::lower_bound(uses_.begin(), uses_.end(), edge,
                                      [](const EdgeUse& use, Edge e) { return use.edge < e; });
  auto end = begin;
  while (end != uses_.end() && end->edge == edge) ++end;
  return {begin, end};
}

std::size_t RefinedMesh::addedVertices() const {
  std::size_t count = 0;
  for (const Vertices& vertices : vertices_) count += vertices.added.size();
  return count;
}

RefinedMesh::Edge RefinedMesh::edgeOf(const TrianglePart& part, int from) const {
  return keyOf(weldedOf(part, from), weldedOf(part, (from + 1) % 3));
}

/// Edges of equal length are compared by their welded vertices, so that all parts agree on which one is
/// longer.
int RefinedMesh::longestOf(const TrianglePart& part) const {
  int longest = 0;
  std::pair<double, Edge> most{-1.0, 0};
  for (int from = 0; from < 3; ++from) {
    const Edge edge = edgeOf(part, from);
    const glm::dvec3 along = toWorld_ * (glm::dvec3(positions_[static_cast<std::uint32_t>(edge >> 32)]) -
                                         glm::dvec3(positions_[static_cast<std::uint32_t>(edge)]));
    const std::pair<double, Edge> own{glm::dot(along, along), edge};
    if (own > most) {
      most = own;
      longest = from;
    }
  }
  return longest;
}

double RefinedMesh::lengthOf(const TrianglePart& part, int from) const {
  return glm::length(toWorld_ * (glm::dvec3(positions_[weldedOf(part, (from + 1) % 3)]) -
                                 glm::dvec3(positions_[weldedOf(part, from)])));
}

double RefinedMesh::longestEdge(const TrianglePart& part) const { return lengthOf(part, longestOf(part)); }

double RefinedMesh::area(const TrianglePart& part) const {
  const glm::dvec3 a(positions_[weldedOf(part, 0)]);
  return 0.5 * glm::length(glm::cross(toWorld_ * (glm::dvec3(positions_[weldedOf(part, 1)]) - a),
                                      toWorld_ * (glm::dvec3(positions_[weldedOf(part, 2)]) - a)));
}

void RefinedMesh::mark(const TrianglePart& part, double others, Edges& edges) const {
  const int longest = longestOf(part);
  for (int from = 0; from < 3; ++from)
    if ((from == longest || lengthOf(part, from) > others) &&
        weldedOf(part, from) != weldedOf(part, (from + 1) % 3))
      edges.insert(edgeOf(part, from));
}

void RefinedMesh::close(Edges& edges) const {
  std::vector<Edge> marked(edges.begin(), edges.end());
  while (!marked.empty()) {
    const Edge edge = marked.back();
    marked.pop_back();
    for (const EdgeUse& use : usesOf(edge)) {
      const TrianglePart& part = parts_[use.part];
      const Edge longest = edgeOf(part, longestOf(part));
      if (edges.insert(longest).second) marked.push_back(longest);
    }
  }
}

std::uint32_t RefinedMesh::middleWelded(std::uint32_t a, std::uint32_t b) {
  const auto [found, fresh] =
      middles_.try_emplace(keyOf(a, b), static_cast<std::uint32_t>(positions_.size()));
  if (fresh) positions_.push_back(middleOf(positions_[a], positions_[b]));
  return found->second;
}

std::uint32_t RefinedMesh::middleVertex(std::uint32_t primitive, std::uint32_t a, std::uint32_t b) {
  Vertices& vertices = vertices_[primitive];
  const auto [found, fresh] =
      vertices.middles.try_emplace(keyOf(a, b), static_cast<std::uint32_t>(vertices.welded.size()));
  if (fresh) {
    vertices.added.push_back({std::min(a, b), std::max(a, b)});
    vertices.welded.push_back(middleWelded(vertices.welded[a], vertices.welded[b]));
  }
  return found->second;
}

/// Returns the two halves of a part: the first has corner `edge`, the second the corner after it, in their
/// old positions among the corners.
std::pair<TrianglePart, TrianglePart> RefinedMesh::bisected(const TrianglePart& part, int edge) {
  const auto from = static_cast<std::size_t>(edge), to = (from + 1) % 3;
  const std::uint32_t middle = middleVertex(part.primitive, part.corners[from], part.corners[to]);
  const glm::dvec2 weights = 0.5 * (part.weights[from] + part.weights[to]);
  std::pair<TrianglePart, TrianglePart> halves{part, part};
  halves.first.error = halves.second.error = 0.5f * part.error;
  halves.first.corners[to] = halves.second.corners[from] = middle;
  halves.first.weights[to] = halves.second.weights[from] = weights;
  return halves;
}

void RefinedMesh::addCut(const TrianglePart& part, const Edges& edges, std::vector<TrianglePart>& parts) {
  const int longest = longestOf(part);
  if (!edges.contains(edgeOf(part, longest))) {
    parts.push_back(part);
    return;
  }
  const int next = (longest + 1) % 3, last = (longest + 2) % 3;
  const bool cutsNext = edges.contains(edgeOf(part, next)), cutsLast = edges.contains(edgeOf(part, last));
  const auto [first, second] = bisected(part, longest);
  // The first half keeps the last edge, the second half the next one.
  for (const auto& [half, edge, cuts] :
       {std::tuple(first, last, cutsLast), std::tuple(second, next, cutsNext)}) {
    if (!cuts) {
      parts.push_back(half);
      continue;
    }
    const auto [one, other] = bisected(half, edge);
    parts.push_back(one);
    parts.push_back(other);
  }
}

std::size_t RefinedMesh::countCuts(const Edges& edges) const {
  std::size_t count = 0;
  std::vector<std::pair<std::uint32_t, std::uint64_t>> cuts;  // of one edge: the primitive and its vertices
  for (const Edge edge : edges) {
    cuts.clear();
    for (const EdgeUse& use : usesOf(edge)) {
      const TrianglePart& part = parts_[use.part];
      cuts.emplace_back(part.primitive, keyOf(part.corners[use.from], part.corners[(use.from + 1u) % 3]));
    }
    std::sort(cuts.begin(), cuts.end());
    count += static_cast<std::size_t>(std::unique(cuts.begin(), cuts.end()) - cuts.begin());
  }
  return count;
}

void RefinedMesh::cut(const Edges& edges) {
  std::vector<TrianglePart> parts;
  parts.reserve(parts_.size() + 2 * edges.size());
  for (const TrianglePart& part : parts_) addCut(part, edges, parts);
  parts_ = std::move(parts);
  listUses();
}

std::vector<RefinedPrimitive> RefinedMesh::refined() const {
  std::vector<RefinedPrimitive> primitives;
  std::vector<std::size_t> placed(vertices_.size());
  for (std::size_t p = 0; p < vertices_.size(); ++p) {
    placed[p] = primitives.size();
    if (!vertices_[p].added.empty()) primitives.push_back({index_, p, vertices_[p].added, {}});
  }
  for (const TrianglePart& part : parts_)
    if (!vertices_[part.primitive].added.empty())
      primitives[placed[part.primitive]].triangles.emplace_back(part.corners[0], part.corners[1],
                                                                part.corners[2]);
  return primitives;
}

}  // namespace prelight
