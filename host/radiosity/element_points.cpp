#include "radiosity/element_points.h"

#include "base/parallel.h"
#include "receivers/sampling.h"

namespace prelight {

namespace {

/// Share of the way to their piece's centroid by which points are moved, away from walls that meet the piece
/// at its edges.
constexpr double pieceInset = 0x1p-10;

}  // namespace

ElementPoints::ElementPoints(const CompiledScene& scene, const RadiosityElements& elements,
                             std::uint64_t seed)
    : scene_(scene),
      elements_(elements),
      seed_(sampling::hashInteger(
          static_cast<std::uint32_t>(seed) ^
          sampling::hashInteger(static_cast<std::uint32_t>(seed >> 32) + 0x51ed270bu))) {}

ElementPoints::Place ElementPoints::at(std::uint32_t element, std::uint32_t triangle, std::uint32_t index,
                                       std::uint32_t rays) const {
  const std::uint32_t piece = element % elements_.perSide() - elements_.first[triangle];
  const std::uint32_t sequence = seed_ ^ sampling::hashInteger(2 * element);
  const glm::dvec2 inPiece = glm::mix(sampling::uniformTriangle(sampling::sobol(index, sequence)),
                                      glm::dvec2(1.0 / 3.0), pieceInset);
  const glm::dvec2 inTriangle = pointOfPiece(elements_.splits[triangle], piece, inPiece);
  // If rounding exceeds that, points are kept off the triangle's edges instead of the piece's.
  const bool coarse = 3.0 * keptOffEdges(scene_, triangle, glm::dvec2(0.0)).x > 2.0 * pieceInset;
  const glm::dvec2 b = coarse ? keptOffEdges(scene_, triangle, inTriangle) : inTriangle;
  Place place{{triangle, static_cast<float>(b.x), static_cast<float>(b.y), 1.0f}, {}};
  place.receiver = receiverAt(scene_, place.sample, elements_.sideOf(element));
  for (int c = 0; c < 3; ++c) place.receiver.normal[c] = place.receiver.geometricNormal[c];
  place.receiver.seed = seed_ ^ sampling::hashInteger(2 * element + 1);
  place.receiver.firstSample = sampling::shuffledIndex(index, seed_ ^ sampling::hashInteger(~element)) * rays;
  return place;
}

std::vector<ElementPoints::Place> ElementPoints::of(const std::vector<std::uint32_t>& elements,
                                                    std::size_t first, std::size_t count,
                                                    std::uint32_t perElement, std::uint32_t rays) const {
  std::vector<Place> places(count * perElement);
  parallelRanges(count, 64, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const std::uint32_t element = elements[first + i], triangle = elements_.triangleOf(element);
      for (std::uint32_t p = 0; p < perElement; ++p)
        places[i * perElement + p] = at(element, triangle, p, rays);
    }
  });
  return places;
}

}  // namespace prelight
