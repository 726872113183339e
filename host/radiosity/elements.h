#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "prelight/compiled_scene.h"
#include "receivers/surface_sampler.h"

namespace prelight {

/// The finite elements of radiosity: triangles, large ones cut evenly into n^2 similar pieces, whose exitance
/// is constant. Both sides have elements; those of the backs follow the fronts':
/// element = side x perSide() + first[triangle] + piece.
struct RadiosityElements {
  std::vector<std::uint32_t> splits;  ///< [triangle], n
  std::vector<std::uint32_t> first;   ///< [triangle + 1], first piece
  std::vector<float> areas;           ///< [triangle], m2 of a piece

  std::uint32_t perSide() const { return first.back(); }
  std::uint32_t triangleOf(std::uint32_t element) const;
  Side sideOf(std::uint32_t element) const { return element < perSide() ? Side::Front : Side::Back; }
};

/// Longest edge of an element when nothing is asked for: about 8192 elements if the surface were one sheet,
/// besides those of small triangles.
double defaultPatchSize(const CompiledScene& scene);

/// Pieces whose edges are at most `patchSize` metres long. Throws Error (BadUsage) when there would be more
/// than 2^28.
RadiosityElements makeElements(const CompiledScene& scene, double patchSize);

/// Number of the piece that a point lies in, of a triangle cut into `splits`^2. (u, v): weights of vertices 1
/// and 2, in [0,1]. Row by row along v; within a row upright and inverted pieces take turns.
std::uint32_t pieceAt(std::uint32_t splits, double u, double v);

/// Weights of the triangle's vertices 1 and 2 at weights `inPiece` (of the piece's own corners 1 and 2).
glm::dvec2 pointOfPiece(std::uint32_t splits, std::uint32_t piece, const glm::dvec2& inPiece);

}  // namespace prelight
