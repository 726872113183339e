#include "techniques/sh/vertex_turns.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace prelight {

namespace {

/// Returns the least rotation that takes one unit vector to another; any of half a turn for opposite ones.
glm::dmat3 swing(const glm::dvec3& from, const glm::dvec3& to) {
  const double cosine = glm::dot(from, to);
  const glm::dvec3 axis = glm::cross(from, to);
  if (cosine < -1.0 + 1e-9) {
    const glm::dvec3 side = std::abs(from.x) < 0.9 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0);
    const glm::dvec3 around = glm::normalize(glm::cross(from, side));
    return 2.0 * glm::outerProduct(around, around) - glm::dmat3(1.0);
  }
  const glm::dmat3 cross(0.0, axis.z, -axis.y, -axis.z, 0.0, axis.x, axis.y, -axis.x, 0.0);
  return glm::dmat3(1.0) + cross + cross * cross / (1.0 + cosine);
}

/// Sums over the edges at a vertex.
struct Edges {
  glm::dmat3 products{0.0};  ///< outer products of an edge in the other pose with itself in this one
  glm::dmat3 squares{0.0};   ///< outer products of an edge in this pose with itself
  double square = 0.0;       ///< m2, squared lengths in this pose
  double otherSquare = 0.0;
};

void addTriangle(const CompiledScene& from, const CompiledScene& to, const glm::uvec3& corners,
                 std::vector<Edges>& edges) {
  for (int i = 0; i < 3; ++i) {
    Edges& sums = edges[corners[i]];
    for (const int j : {(i + 1) % 3, (i + 2) % 3}) {
      const glm::dvec3 before =
          glm::dvec3(from.positions[corners[j]]) - glm::dvec3(from.positions[corners[i]]);
      const glm::dvec3 after = glm::dvec3(to.positions[corners[j]]) - glm::dvec3(to.positions[corners[i]]);
      sums.products += glm::outerProduct(after, before);
      sums.squares += glm::outerProduct(before, before);
      sums.square += glm::dot(before, before);
      sums.otherSquare += glm::dot(after, after);
    }
  }
}

}  // namespace

double greatestDifference(const glm::dmat3& a, const glm::dmat3& b) {
  double greatest = 0.0;
  for (int column = 0; column < 3; ++column)
    for (int row = 0; row < 3; ++row)
      greatest = std::max(greatest, std::abs(a[column][row] - b[column][row]));
  return greatest;
}

glm::dmat3 rotationOf(const glm::dmat4& map) {
  glm::dmat3 rotation(map);
  if (!(glm::determinant(rotation) > 0.0)) return glm::dmat3(1.0);
  // Newton's iteration for the orthogonal polar factor (Higham 1986, Eq. 3.4), which converges quadratically.
  constexpr int mostSteps = 64;
  for (int step = 0; step < mostSteps; ++step) {
    const glm::dmat3 next = 0.5 * (rotation + glm::transpose(glm::inverse(rotation)));
    const double change = greatestDifference(next, rotation);
    rotation = next;
    if (change < 1e-15) break;
  }
  const double error = greatestDifference(rotation * glm::transpose(rotation), glm::dmat3(1.0));
  return error < 1e-9 ? rotation : glm::dmat3(1.0);
}

std::vector<glm::dmat3> vertexTurns(const CompiledScene& from, const CompiledScene& to) {
  assert(from.vertexCount() == to.vertexCount());
  std::vector<Edges> edges(from.vertexCount());
  for (const glm::uvec3& corners : from.triangles) addTriangle(from, to, corners, edges);
  std::vector<glm::dmat3> turns(edges.size(), glm::dmat3(1.0));
  for (std::size_t v = 0; v < edges.size(); ++v) {
    const glm::dvec3 before(from.normals[v]), after(to.normals[v]);
    const Edges& sums = edges[v];
    const double scale = std::sqrt(sums.square * sums.otherSquare);
    // Edges may lie in one plane, so the normal counts as much as they do.
    const glm::dmat3 products = sums.products + scale * glm::outerProduct(after, before);
    const glm::dmat3 squares = sums.squares + sums.square * glm::outerProduct(before, before);
    const bool known = glm::determinant(squares) > 1e-9 * sums.square * sums.square * sums.square &&
                       glm::determinant(products) > 1e-9 * scale * scale * scale;
    turns[v] = known ? rotationOf(glm::dmat4(products * glm::inverse(squares))) : swing(before, after);
  }
  return turns;
}

}  // namespace prelight
