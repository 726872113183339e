#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "prelight/compiled_scene.h"
#include "receivers/surface_sampler.h"
#include "shared/cast_types.h"

namespace prelight {

/// The finite elements of radiosity, each with constant exitance: triangles, of which large ones are divided
/// into n^2 similar pieces. Both sides have elements, those of the backs after those of the fronts: element =
/// side x perSide() + first[triangle] + piece.
struct RadiosityElements {
  std::vector<std::uint32_t> splits;  ///< [triangle], n
  std::vector<std::uint32_t> first;   ///< [triangle + 1], first piece
  std::vector<float> areas;           ///< [triangle], area of a piece, m2

  std::uint32_t perSide() const { return first.back(); }
  std::uint32_t triangleOf(std::uint32_t element) const;
  Side sideOf(std::uint32_t element) const { return element < perSide() ? Side::Front : Side::Back; }
};

/// Returns the default for the longest edge of an element, which gives about 8192 elements if the surface
/// were one sheet, in addition to those of small triangles.
double defaultPatchSize(const CompiledScene& scene);

/// Makes elements with edges of at most `patchSize` metres. Throws Error (BadUsage) for more than 2^28
/// elements.
RadiosityElements makeElements(const CompiledScene& scene, double patchSize);

/// Returns the number of the piece that contains a point of a triangle divided into `splits`^2 pieces. (u, v)
/// are the weights of vertices 1 and 2, in [0,1]. Pieces are numbered row by row along v; upright and
/// inverted pieces alternate in a row.
std::uint32_t pieceAt(std::uint32_t splits, double u, double v);

/// Returns the weights of the triangle's vertices 1 and 2 for weights `inPiece` of the piece's corners 1 and
/// 2.
glm::dvec2 pointOfPiece(std::uint32_t splits, std::uint32_t piece, const glm::dvec2& inPiece);

/// Low-discrepancy points on elements, which are reproducible by index.
class ElementPoints {
 public:
  /// The arguments must outlive the object.
  ElementPoints(const CompiledScene& scene, const RadiosityElements& elements, std::uint64_t seed);

  struct Place {
    SurfaceSample sample;       ///< weight 1
    device::Receiver receiver;  ///< looks along the geometric normal
  };

  /// Returns point `index` of an element, whose receiver casts `rays` rays of the element's sequence.
  Place at(std::uint32_t element, std::uint32_t triangle, std::uint32_t index, std::uint32_t rays) const;

  /// Returns points [0, perElement) of elements [first, first + count), [element][point], using all cores.
  std::vector<Place> of(const std::vector<std::uint32_t>& elements, std::size_t first, std::size_t count,
                        std::uint32_t perElement, std::uint32_t rays) const;

 private:
  const CompiledScene& scene_;
  const RadiosityElements& elements_;
  std::uint32_t seed_;
};

/// Returns the mean radiance that each element of a triangle emits, W/(m2 sr), [piece], or nothing if the
/// triangle does not emit.
std::vector<glm::vec3> emissionOfElements(const CompiledScene& scene, const RadiosityElements& elements,
                                          std::uint32_t triangle);

}  // namespace prelight
