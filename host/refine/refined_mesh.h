#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <unordered_map>
#include <unordered_set>
#include <utility>
#include <vector>

#include "prelight/scene.h"

namespace prelight {

/// A part of a triangle that is subdivided, or all of it.
struct TrianglePart {
  std::uint32_t primitive = 0;             ///< index in the mesh
  std::uint32_t root = 0;                  ///< triangle of the file
  std::array<std::uint32_t, 3> corners{};  ///< vertices of the primitive, wound as in the file
  std::array<glm::dvec2, 3> weights{};     ///< [corner] weights of the root's corners 1 and 2 there
  /// Estimate for this part, or what follows from that of the larger one that it is cut from: for smooth
  /// functions it falls with the area.
  float error = 0.0f;
  bool open = true;  ///< whether the part may have to be cut further
};

/// A subdivided primitive. New vertices follow the existing ones; each lies halfway between two vertices
/// before it.
struct RefinedPrimitive {
  std::size_t mesh = 0;
  std::size_t primitive = 0;
  std::vector<std::array<std::uint32_t, 2>> added;  ///< [new vertex], the two vertices that it lies between
  std::vector<glm::uvec3> triangles;                ///< all triangles, wound as in the file
};

/// The triangles of a mesh while they are subdivided. Vertices of all its primitives that have the same
/// position are one welded vertex, and edges with the same welded vertices are cut alike, so that no cracks
/// open. A part is
/// cut at its longest edge first, which keeps angles from becoming ever smaller (Rivara 1984).
class RefinedMesh {
 public:
  /// The key of an edge: its two welded vertices.
  using Edge = std::uint64_t;
  using Edges = std::unordered_set<Edge>;

  /// `toWorld` scales the lengths by which edges are compared.
  RefinedMesh(const Mesh& mesh, std::size_t index, const glm::dmat3& toWorld);

  std::size_t index() const { return index_; }
  std::vector<TrianglePart>& parts() { return parts_; }
  const std::vector<TrianglePart>& parts() const { return parts_; }
  std::size_t addedVertices() const;

  /// Returns the length of a part's longest edge, m.
  double longestEdge(const TrianglePart& part) const;

  /// Returns a part's area, m2.
  double area(const TrianglePart& part) const;

  /// Marks the longest edge of a part, and its other edges that are longer than `others`, m.
  void mark(const TrianglePart& part, double others, Edges& edges) const;

  /// Marks the longest edge of every part that has a marked edge, until nothing changes.
  void close(Edges& edges) const;

  /// Returns how many vertices cut() would add.
  std::size_t countCuts(const Edges& edges) const;

  /// Cuts all marked edges, which must be closed.
  void cut(const Edges& edges);

  /// Returns the primitives that have been cut.
  std::vector<RefinedPrimitive> refined() const;

 private:
  /// Vertices of a primitive.
  struct Vertices {
    std::vector<std::uint32_t> welded;  ///< [vertex], its welded vertex
    std::size_t originals = 0;
    std::vector<std::array<std::uint32_t, 2>> added;
    std::unordered_map<std::uint64_t, std::uint32_t> middles;  ///< by the two vertices, the lower one first
  };

  /// A part and one of its edges.
  struct EdgeUse {
    Edge edge = 0;
    std::uint32_t part = 0;
    std::uint8_t from = 0;  ///< corner at which the edge begins
  };

  std::uint32_t weldedOf(const TrianglePart& part, int corner) const {
    return vertices_[part.primitive].welded[part.corners[static_cast<std::size_t>(corner)]];
  }
  Edge edgeOf(const TrianglePart& part, int from) const;
  int longestOf(const TrianglePart& part) const;
  double lengthOf(const TrianglePart& part, int from) const;
  void listUses();
  std::span<const EdgeUse> usesOf(Edge edge) const;
  std::uint32_t middleWelded(std::uint32_t a, std::uint32_t b);
  std::uint32_t middleVertex(std::uint32_t primitive, std::uint32_t a, std::uint32_t b);
  std::pair<TrianglePart, TrianglePart> bisected(const TrianglePart& part, int edge);
  void addCut(const TrianglePart& part, const Edges& edges, std::vector<TrianglePart>& parts);

  std::size_t index_;
  glm::dmat3 toWorld_;
  std::vector<glm::vec3> positions_;  ///< [welded vertex], in the mesh's space
  std::unordered_map<Edge, std::uint32_t> middles_;
  std::vector<Vertices> vertices_;  ///< [primitive]
  std::vector<TrianglePart> parts_;
  std::vector<EdgeUse> uses_;  ///< by edge and part
};

/// Returns the point halfway between two vertices, as files and scenes have it.
inline glm::vec3 middleOf(const glm::vec3& a, const glm::vec3& b) {
  return glm::vec3(0.5 * (glm::dvec3(a) + glm::dvec3(b)));
}

/// Returns a triangle of a primitive with the corners in the order of the file.
glm::uvec3 fileTriangle(const Primitive& primitive, std::size_t triangle);

}  // namespace prelight
