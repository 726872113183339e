#include "radiosity/elements.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "base/parallel.h"
#include "prelight/error.h"
#include "receivers/sampling.h"
#include "scene/light_sources.h"
#include "scene/surface/triangles.h"

namespace prelight {

namespace {

constexpr double usualElements = 8192.0;
constexpr double mostElements = double(1u << 28);

double longestEdge(const CompiledScene& scene, std::uint32_t triangle) {
  const auto& t = scene.triangles[triangle];
  const glm::dvec3 a(scene.positions[t.x]), b(scene.positions[t.y]), c(scene.positions[t.z]);
  return std::max({glm::length(b - a), glm::length(c - b), glm::length(a - c)});
}

}  // namespace

std::uint32_t RadiosityElements::triangleOf(std::uint32_t element) const {
  const std::uint32_t piece = element % perSide();
  return static_cast<std::uint32_t>(std::upper_bound(first.begin(), first.end(), piece) - first.begin()) - 1;
}

double defaultPatchSize(const CompiledScene& scene) {
  double area = 0.0;
  for (std::uint32_t t = 0; t < scene.triangleCount(); ++t)
    area += 0.5 * glm::length(geometricNormal(scene, t));
  // This is the longest edge of half a square of the mean area of an element.
  return 2.0 * std::sqrt(area / usualElements);
}

RadiosityElements makeElements(const CompiledScene& scene, double patchSize) {
  RadiosityElements elements;
  elements.first.push_back(0);
  double count = 0.0;
  for (std::uint32_t t = 0; t < scene.triangleCount(); ++t) {
    const double splits = std::max(1.0, std::ceil(longestEdge(scene, t) / patchSize - 1e-6));
    count += splits * splits;
    if (count > mostElements)
      throw UsageError(
          "RadiosityRequest::patchSize",
          fmt::format("{} m makes more than {:.0f} elements of this scene", patchSize, mostElements),
          "take larger patches");
    elements.splits.push_back(static_cast<std::uint32_t>(splits));
    elements.first.push_back(static_cast<std::uint32_t>(count));
    elements.areas.push_back(
        static_cast<float>(0.5 * glm::length(geometricNormal(scene, t)) / (splits * splits)));
  }
  return elements;
}

std::uint32_t pieceAt(std::uint32_t splits, double u, double v) {
  if (splits == 1) return 0;
  const double x = u * splits, y = v * splits;
  const auto row = std::min(splits - 1, static_cast<std::uint32_t>(std::max(0.0, y)));
  const auto column = std::min(splits - 1 - row, static_cast<std::uint32_t>(std::max(0.0, x)));
  const bool inverted = column + row + 1 < splits && (x - column) + (y - row) > 1.0;
  return row * (2 * splits - row) + 2 * column + (inverted ? 1 : 0);
}

glm::dvec2 pointOfPiece(std::uint32_t splits, std::uint32_t piece, const glm::dvec2& inPiece) {
  // Row r starts at piece r (2 splits - r).
  const double n = splits;
  auto row = static_cast<std::uint32_t>(n - std::sqrt(std::max(0.0, n * n - piece)));
  while (row > 0 && row * (2 * splits - row) > piece) --row;
  while ((row + 1) * (2 * splits - row - 1) <= piece) ++row;
  const std::uint32_t place = piece - row * (2 * splits - row);
  const glm::dvec2 corner(place / 2, row);
  const glm::dvec2 at = place % 2 == 0 ? corner + inPiece : corner + 1.0 - inPiece;
  return at / n;
}

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

namespace {

using Polygon = std::vector<glm::dvec2>;
using PieceCorners = std::array<glm::dvec2, 3>;

/// Returns the area of the intersection of two triangles of equal orientation (Sutherland and Hodgman 1974).
double sharedArea(const PieceCorners& a, const PieceCorners& b) {
  Polygon rest(a.begin(), a.end());
  for (std::size_t k = 0; k < 3 && !rest.empty(); ++k) {
    const glm::dvec2 from = b[k], way = b[(k + 1) % 3] - from;
    Polygon kept;
    for (std::size_t i = 0; i < rest.size(); ++i) {
      const glm::dvec2 &p = rest[i], &q = rest[(i + 1) % rest.size()];
      const double hp = cross(way, p - from), hq = cross(way, q - from);
      if (hp >= 0.0) kept.push_back(p);
      if ((hp > 0.0 && hq < 0.0) || (hp < 0.0 && hq > 0.0)) kept.push_back(p + hp / (hp - hq) * (q - p));
    }
    rest = std::move(kept);
  }
  double area = 0.0;
  for (std::size_t i = 0; i < rest.size(); ++i) area += 0.5 * cross(rest[i], rest[(i + 1) % rest.size()]);
  return area;
}

/// Adds an emitter to the pieces that it overlaps. There are n pieces per side, row by row along v, as
/// pieceAt() numbers them.
void addTo(const Emitter& emitter, std::uint32_t n, std::vector<glm::dvec3>& pieces) {
  const PieceCorners own = {placeOn(emitter, {0, 0}), placeOn(emitter, {1, 0}), placeOn(emitter, {0, 1})};
  const glm::dvec2 low = glm::min(own[0], glm::min(own[1], own[2])),
                   high = glm::max(own[0], glm::max(own[1], own[2]));
  const auto cell = [&](double x) {
    return static_cast<std::uint32_t>(std::clamp(std::floor(x * n), 0.0, double(n - 1)));
  };
  const double pieceArea = 0.5 / (double(n) * n);
  for (std::uint32_t row = cell(low.y); row <= cell(high.y); ++row)
    for (std::uint32_t column = cell(low.x); column <= cell(high.x) && column + row < n; ++column)
      for (std::uint32_t inverted = 0; inverted < 2; ++inverted) {
        if (inverted == 1 && column + row + 1 >= n) continue;
        const std::uint32_t piece = row * (2 * n - row) + 2 * column + inverted;
        const PieceCorners corners = {pointOfPiece(n, piece, {0, 0}), pointOfPiece(n, piece, {1, 0}),
                                      pointOfPiece(n, piece, {0, 1})};
        pieces[piece] += sharedArea(own, corners) / pieceArea * glm::dvec3(emitter.radiance);
      }
}

}  // namespace

std::vector<glm::vec3> emissionOfElements(const CompiledScene& scene, const RadiosityElements& elements,
                                          std::uint32_t triangle) {
  const std::vector<Emitter> emitters = emittersOf(scene, triangle);
  const std::uint32_t n = elements.splits[triangle];
  if (emitters.empty()) return {};
  if (emitters.size() == 1 && emitters[0].scale == 1.0f)
    return std::vector<glm::vec3>(std::size_t{n} * n, emitters[0].radiance);
  std::vector<glm::dvec3> sums(std::size_t{n} * n, glm::dvec3(0.0));
  for (const Emitter& emitter : emitters) addTo(emitter, n, sums);
  return {sums.begin(), sums.end()};
}

}  // namespace prelight
