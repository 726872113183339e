#include "charts/texel_cells.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/parallel.h"
#include "charts/light_map_lookup.h"
#include "receivers/sampling.h"
#include "receivers/surface_sampler.h"
#include "scene/surface/triangles.h"

namespace prelight {

namespace {

constexpr double edgeSlack = 1e-5;  // share of a face's heights: places on its edge count as inside

/// Returns the offset of place i from a texel's own, in texels, for half of the places; the others are
/// opposite. The places are a lattice of rank 1 that is its own mirror image, with sixteen different columns
/// and rows, so that a shadow's edge along a row or column of texels has as many steps as any other. Their
/// order distributes the first few evenly, too.
glm::dvec2 offsetOf(std::size_t i) {
  constexpr std::array<int, TexelCells::placeCount / 2> order = {3, 6, 2, 7, 0, 1, 4, 5};
  constexpr double count = static_cast<double>(TexelCells::placeCount);
  const double turns = (7.0 * order[i] + 3.5) / count;
  return TexelCells::side * glm::dvec2((order[i] + 0.5) / count - 0.5, turns - std::floor(turns) - 0.5);
}

std::array<glm::dvec2, 3> cornersOf(const LightMapLayout& layout, std::uint32_t face) {
  const glm::vec2* c = &layout.corners[3 * std::size_t{face}];
  return {glm::dvec2(c[0]), glm::dvec2(c[1]), glm::dvec2(c[2])};
}

double leastOf(const glm::dvec2& weights) {
  return std::min({weights.x, weights.y, 1.0 - weights.x - weights.y});
}

/// Returns the weights of corners 1 and 2 if the place lies in the triangle.
std::optional<glm::dvec2> weightsIn(const std::array<glm::dvec2, 3>& c, const glm::dvec2& place) {
  const double area = cross(c[1] - c[0], c[2] - c[0]);
  if (!(std::abs(area) > 1e-12)) return std::nullopt;
  const glm::dvec2 w(cross(place - c[0], c[2] - c[0]) / area, cross(c[1] - c[0], place - c[0]) / area);
  if (leastOf(w) < -edgeSlack) return std::nullopt;
  const glm::dvec2 inside = glm::max(w, glm::dvec2(0.0));
  return inside / std::max(1.0, inside.x + inside.y);
}

/// Returns a texel's place moved to a point of a face. Only points near the face's edges are kept off them:
/// moving all would shift the mean of a cell.
LightMapTexel placeOn(const CompiledScene& scene, const LightMapTexel& texel, std::uint32_t face,
                      const glm::dvec2& weights) {
  const std::uint32_t triangle = face % scene.triangleCount();
  // Least weight of a point on an edge once it is kept off.
  const double reach = leastOf(keptOffEdges(scene, triangle, {0.0, 0.5}));
  const glm::dvec2 b = leastOf(weights) < reach ? keptOffEdges(scene, triangle, weights) : weights;
  LightMapTexel place = texel;
  place.face = face;
  place.b1 = static_cast<float>(b.x);
  place.b2 = static_cast<float>(b.y);
  return place;
}

/// Calls visit for every square of a texel into which a triangle reaches.
template <typename Visit>
void forEachSquare(const LightMapLayout& layout, std::uint32_t face, const Visit& visit) {
  const std::array<glm::dvec2, 3> c = cornersOf(layout, face);
  const glm::dvec2 low = glm::min(c[0], glm::min(c[1], c[2])), high = glm::max(c[0], glm::max(c[1], c[2]));
  const int right = std::min(layout.width - 1, static_cast<int>(std::floor(high.x))),
            bottom = std::min(layout.height - 1, static_cast<int>(std::floor(high.y)));
  for (int y = std::max(0, static_cast<int>(std::floor(low.y))); y <= bottom; ++y)
    for (int x = std::max(0, static_cast<int>(std::floor(low.x))); x <= right; ++x) {
      const glm::dvec2 centre(x + 0.5, y + 0.5);
      bool apart = false;
      for (std::size_t i = 0; i < 3 && !apart; ++i) {
        const glm::dvec2 &from = c[i], edge = c[(i + 1) % 3] - from;
        const glm::dvec2 normal(-edge.y, edge.x);
        const double reach = 0.5 * (std::abs(normal.x) + std::abs(normal.y)),
                     centreSide = glm::dot(centre - from, normal),
                     thirdSide = glm::dot(c[(i + 2) % 3] - from, normal);
        apart = thirdSide >= 0.0 ? centreSide < -reach : centreSide > reach;
      }
      if (!apart)
        visit(static_cast<std::size_t>(y) * static_cast<std::size_t>(layout.width) +
              static_cast<std::size_t>(x));
    }
}

}  // namespace

TexelCells::TexelCells(const CompiledScene& scene, const LightMapLayout& layout)
    : scene_(scene), layout_(layout), firstFace_(layout.texelCount() + 1, 0) {
  const auto faceCount = static_cast<std::uint32_t>(layout.chartOf.size());
  const auto forEach = [&](const auto& visit) {
    for (std::uint32_t face = 0; face < faceCount; ++face)
      if (layout.chartOf[face] != LightMapLayout::noChart)
        forEachSquare(layout, face, [&](std::size_t square) { visit(square, face); });
  };
  forEach([&](std::size_t square, std::uint32_t) { ++firstFace_[square + 1]; });
  for (std::size_t i = 1; i < firstFace_.size(); ++i) firstFace_[i] += firstFace_[i - 1];
  faces_.resize(firstFace_.back());
  std::vector<std::uint32_t> next(firstFace_.begin(), firstFace_.end() - 1);
  forEach([&](std::size_t square, std::uint32_t face) { faces_[next[square]++] = face; });
}

std::span<const std::uint32_t> TexelCells::facesAt(const glm::dvec2& place) const {
  const int x = static_cast<int>(std::floor(place.x)), y = static_cast<int>(std::floor(place.y));
  if (x < 0 || y < 0 || x >= layout_.width || y >= layout_.height) return {};
  const std::size_t square =
      static_cast<std::size_t>(y) * static_cast<std::size_t>(layout_.width) + static_cast<std::size_t>(x);
  return std::span(faces_).subspan(firstFace_[square], firstFace_[square + 1] - firstFace_[square]);
}

std::optional<LightMapTexel> TexelCells::at(const LightMapTexel& texel, const glm::dvec2& place) const {
  const auto placed = [&](std::uint32_t face) -> std::optional<LightMapTexel> {
    const std::optional<glm::dvec2> weights = weightsIn(cornersOf(layout_, face), place);
    if (!weights) return std::nullopt;
    return placeOn(scene_, texel, face, *weights);
  };
  if (std::optional<LightMapTexel> found = placed(texel.face)) return found;
  for (const std::uint32_t face : facesAt(place)) {
    if (layout_.chartOf[face] != layout_.chartOf[texel.face]) continue;
    if (std::optional<LightMapTexel> found = placed(face)) return found;
  }
  return std::nullopt;
}

void TexelCells::spreadOverChart(const LightMapTexel& texel, Places& places) const {
  std::vector<std::uint32_t> faces;
  std::vector<double> sums;  // cumulative areas, m2
  double sum = 0.0;
  for (const std::uint32_t face : facesAt(lightMapPlace(layout_, texel.face, 0.0, 0.0))) {
    if (layout_.chartOf[face] != layout_.chartOf[texel.face]) continue;
    sum += 0.5 * glm::length(geometricNormal(scene_, face % scene_.triangleCount()));
    faces.push_back(face);
    sums.push_back(sum);
  }
  if (faces.empty()) return;
  for (std::size_t i = 0; i < placeCount; ++i) {
    const double share = (static_cast<double>(i) + 0.5) / static_cast<double>(placeCount);
    const auto at = std::lower_bound(sums.begin(), sums.end() - 1, share * sum) - sums.begin();
    const std::uint32_t face = faces[static_cast<std::size_t>(at)];
    const glm::dvec2 point = sampling::sobol(static_cast<std::uint32_t>(i), sampling::hashInteger(face));
    places[i] = placeOn(scene_, texel, face, sampling::uniformTriangle(point));
  }
}

TexelCells::Places TexelCells::around(const LightMapTexel& texel) const {
  Places places;
  places.fill(texel);
  if (!texel.whole) return places;
  if (texelsOf(layout_, texel.face) == 0.0) {
    spreadOverChart(texel, places);
    return places;
  }
  const glm::dvec2 middle = lightMapPlace(layout_, texel.face, double(texel.b1), double(texel.b2));
  for (std::size_t i = 0; i < placeCount / 2; ++i) {
    const glm::dvec2 offset = offsetOf(i);
    for (const glm::dvec2& tried : {offset, glm::dvec2(offset.x, 0.0), glm::dvec2(0.0, offset.y)}) {
      const std::optional<LightMapTexel> one = at(texel, middle + tried), other = at(texel, middle - tried);
      if (!one || !other) continue;
      places[2 * i] = *one;
      places[2 * i + 1] = *other;
      break;
    }
  }
  return places;
}

std::vector<LightMapTexel> TexelCells::within(const LightMapTexel& texel) const {
  constexpr int across = 4;
  std::vector<glm::dvec2> offsets;  // from the square's middle
  for (int y = 0; y < across; ++y)
    for (int x = 0; x < across; ++x) offsets.push_back((glm::dvec2(x, y) + 0.5) / double(across) - 0.5);
  std::ranges::stable_sort(offsets, {}, [](const glm::dvec2& offset) { return glm::dot(offset, offset); });
  const auto width = static_cast<std::uint32_t>(layout_.width);
  const glm::dvec2 middle = glm::dvec2(texel.texel % width, texel.texel / width) + 0.5;
  std::vector<LightMapTexel> places;
  for (const glm::dvec2& offset : offsets)
    if (std::optional<LightMapTexel> place = at(texel, middle + offset)) places.push_back(*place);
  return places;
}

void spreadReceivers(const CompiledScene& scene, std::span<const LightMapTexel> texels,
                     const TexelCells* cells, std::uint32_t perTexel,
                     std::vector<device::Receiver>& receivers) {
  receivers.resize(texels.size() * perTexel);
  parallelRanges(texels.size(), 256, [&](std::size_t begin, std::size_t end) {
    for (std::size_t t = begin; t < end; ++t) {
      const auto first = receivers.begin() + static_cast<std::ptrdiff_t>(t * perTexel);
      if (cells == nullptr || perTexel == 1) {
        std::fill_n(first, perTexel, receiverAt(scene, texels[t]));
        continue;
      }
      const TexelCells::Places places = cells->around(texels[t]);
      for (std::uint32_t r = 0; r < perTexel; ++r)
        first[r] = r < places.size() ? receiverAt(scene, places[r]) : first[r % places.size()];
    }
  });
}

namespace {

constexpr double leastStep = 0.04;     // share of all light at the brighter of two texels
constexpr double darkestLight = 0.01;  // share of the map's mean; steps between darker texels are not visible

class EdgeFinder {
 public:
  EdgeFinder(const LightMapLayout& layout, const TexelLight& light)
      : layout_(layout), light_(light), indexOf_(layout.texelCount(), nothing) {
    double sum = 0.0;
    for (std::uint32_t i = 0; i < layout.texels.size(); ++i) {
      indexOf_[layout.texels[i].texel] = i;
      sum += double(light.all[i]);
    }
    dark_ = darkestLight * sum / static_cast<double>(std::max<std::size_t>(layout.texels.size(), 1));
  }

  bool isEdge(std::uint32_t i) const {
    const LightMapTexel& texel = layout_.texels[i];
    if (!texel.whole || light_.hidden[i] != 0) return false;
    const int width = layout_.width, x = static_cast<int>(texel.texel) % width,
              y = static_cast<int>(texel.texel) / width;
    for (int row = std::max(0, y - 1); row <= std::min(layout_.height - 1, y + 1); ++row)
      for (int column = std::max(0, x - 1); column <= std::min(width - 1, x + 1); ++column)
        if (differs(i, indexOf_[static_cast<std::size_t>(row) * static_cast<std::size_t>(width) +
                                static_cast<std::size_t>(column)]))
          return true;
    return false;
  }

 private:
  static constexpr std::uint32_t nothing = std::numeric_limits<std::uint32_t>::max();

  bool differs(std::uint32_t i, std::uint32_t other) const {
    if (other == nothing || light_.hidden[other] != 0) return false;
    if (layout_.chartOf[layout_.texels[i].face] != layout_.chartOf[layout_.texels[other].face]) return false;
    const double step = std::abs(double(light_.sharp[i]) - double(light_.sharp[other]));
    return step > leastStep * std::max({double(light_.all[i]), double(light_.all[other]), dark_});
  }

  const LightMapLayout& layout_;
  const TexelLight& light_;
  std::vector<std::uint32_t> indexOf_;  ///< [texel of the map] index in layout.texels, or `nothing`
  double dark_ = 0.0;
};

}  // namespace

std::vector<std::uint32_t> edgeTexels(const LightMapLayout& layout, const TexelLight& light) {
  const EdgeFinder finder(layout, light);
  std::vector<std::uint32_t> edges;
  for (std::uint32_t i = 0; i < layout.texels.size(); ++i)
    if (finder.isEdge(i)) edges.push_back(i);
  return edges;
}

}  // namespace prelight
