#include "radiosity/element_emission.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "scene/emitters.h"

namespace prelight {

namespace {

using Polygon = std::vector<glm::dvec2>;
using PieceCorners = std::array<glm::dvec2, 3>;

double cross(const glm::dvec2& a, const glm::dvec2& b) { return a.x * b.y - a.y * b.x; }

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
