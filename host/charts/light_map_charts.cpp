#include "charts/light_map_charts.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>

#include "charts/chart_growth.h"
#include "charts/chart_shape.h"
#include "charts/file_islands.h"
#include "charts/make_light_map_layout.h"

namespace prelight {

namespace {

constexpr double leastTexels = 4.0;  // pieces of less area than these texels join others
constexpr int mostLayers = 24;       // layers of overlapping triangles; further ones get separate charts
// Greatest number of texels that is chosen.
constexpr double mostTexels = 0.5 * mostLightMapSide * mostLightMapSide;

struct Piece {
  std::vector<std::uint32_t> triangles;
  glm::dvec3 axis{0.0};
};

/// Returns two unit vectors that span the plane of a normal.
std::array<glm::dvec3, 2> planeOf(const glm::dvec3& normal) {
  const glm::dvec3 helper = std::abs(normal.x) < 0.7 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0);
  const glm::dvec3 u = glm::normalize(glm::cross(helper, normal));
  return {u, glm::cross(normal, u)};
}

/// Returns a texel size at which charts take about as many texels as requested: texels of small charts and
/// along edges are added to those of the surface's area. It is at most twice the size that the area alone
/// gives, otherwise many small charts would take all texels from the large ones; and no chart is longer than
/// half the largest map.
double fittingSize(const LightMapCharts& charts, std::uint32_t wanted) {
  std::vector<double> areas;
  double longest = 0.0;
  for (const LightMapChart& chart : charts.charts) {
    areas.push_back(flatArea(chart));
    longest = std::max(longest, chart.size.x);
  }
  const auto count = [&](double texelSize) {
    double sum = 0.0;
    for (std::size_t c = 0; c < areas.size(); ++c) {
      const glm::dvec2 across = charts.charts[c].size / texelSize;
      sum += std::max(across.x, across.y) < leastChartAcross
                 ? 1.0
                 : areas[c] / (texelSize * texelSize) + across.x + across.y + 1.0;
    }
    return sum;
  };
  double low = charts.texelSize, high = 2.0 * charts.texelSize;
  for (int i = 0; i < 24; ++i) {
    const double middle = std::sqrt(low * high);
    (count(middle) > wanted ? low : high) = middle;
  }
  while (count(high) > mostTexels) high *= 1.1;
  return std::max(high, 2.0 * longest / mostLightMapSide);
}

class ChartsMaker {
 public:
  ChartsMaker(const Scene& scene, const CompiledScene& compiled, const LightMapLayoutRequest& request)
      : scene_(scene), compiled_(compiled), request_(request) {}

  LightMapCharts make() {
    measure();
    const SurfaceRegions regions = makeSurfaceRegions(compiled_, request_.creaseAngle);
    const bool given = request_.texelSize > 0.0;
    const std::uint32_t texels =
        given || request_.texels > 0 ? std::max(1u, request_.texels) : usualTexels(compiled_, regions).count;
    result_.texelSize = given ? request_.texelSize : std::sqrt(result_.area / texels);
    neighbours_ = neighboursOf(compiled_, groups_);
    const GrownCharts grown = growCharts(compiled_, regions, groups_, neighbours_,
                                         leastTexels * result_.texelSize * result_.texelSize);
    std::vector<Piece> pieces(grown.axes.size());
    for (std::uint32_t t = 0; t < compiled_.triangleCount(); ++t)
      if (grown.chartOf[t] != noGroup) pieces[grown.chartOf[t]].triangles.push_back(t);
    for (std::size_t c = 0; c < pieces.size(); ++c) {
      pieces[c].axis = grown.axes[c];
      if (!pieces[c].triangles.empty()) project(std::move(pieces[c]));
    }
    preferFileIslands(scene_, compiled_, result_);
    addBacks();
    if (!given) result_.texelSize = fittingSize(result_, texels);
    return std::move(result_);
  }

 private:
  bool isWanted(const CompiledMaterial& material, bool back) const {
    if (hasLight(material, back)) return true;
    return request_.wideMetals && isWideMetal(material) && (!back || material.doubleSided);
  }

  /// Forms groups: one per primitive, with separate ones for triangles with and without a back.
  void measure() {
    groups_.assign(compiled_.triangleCount(), noGroup);
    for (std::size_t p = 0; p < compiled_.primitives.size(); ++p) {
      const PrimitiveRange& range = compiled_.primitives[p];
      for (std::uint32_t i = 0; i < range.triangleCount; ++i) {
        const std::uint32_t t = range.firstTriangle + i;
        const CompiledMaterial& material = compiled_.materials[compiled_.triangleMaterials[t]];
        areas_.push_back(0.5 * glm::length(geometricNormal(compiled_, t)));
        if (!isWanted(material, false)) continue;
        groups_[t] = static_cast<std::uint32_t>(p);
        result_.area += areas_[t] * (isWanted(material, true) ? 2.0 : 1.0);
      }
    }
  }

  static void setShape(const ChartShape& shape, LightMapChart& chart) {
    chart.corners.assign(shape.corners.begin(), shape.corners.end());
    chart.size = shape.size;
  }

  /// Projects a piece, in layers where triangles overlap.
  void project(Piece piece) {
    for (int layer = 0; !piece.triangles.empty(); ++layer) {
      if (layer == mostLayers) {
        for (const std::uint32_t t : piece.triangles) addChart({t}, flatten({{t}, piece.axis}));
        return;
      }
      const ChartShape shape = flatten(piece);
      std::vector<std::uint32_t> order(piece.triangles.size());
      std::iota(order.begin(), order.end(), 0u);
      std::vector<std::uint8_t> free = withoutOverlap(shape, order);
      if (std::count(free.begin(), free.end(), 0) == 0) {
        addChart(std::move(piece.triangles), shape);
        return;
      }
      free = withoutOverlap(shape, outwards(piece.triangles));
      Piece kept{{}, piece.axis}, rest{{}, piece.axis};
      for (std::size_t i = 0; i < free.size(); ++i)
        (free[i] != 0 ? kept : rest).triangles.push_back(piece.triangles[i]);
      const ChartShape keptShape = flatten(kept);
      addChart(std::move(kept.triangles), keptShape);
      piece = std::move(rest);
    }
  }

  ChartShape flatten(const Piece& piece) const {
    const auto [u, v] = planeOf(piece.axis);
    std::vector<glm::dvec2> corners;
    double area = 0.0;
    for (const std::uint32_t t : piece.triangles) {
      area += areas_[t];
      for (int corner = 0; corner < 3; ++corner) {
        const glm::dvec3 p(compiled_.positions[compiled_.triangles[t][corner]]);
        corners.emplace_back(glm::dot(p, u), glm::dot(p, v));
      }
    }
    return shapeOf(std::move(corners), area);
  }

  /// Returns indices into a list of triangles, ordered so that each is connected to an earlier one where
  /// possible.
  std::vector<std::uint32_t> outwards(const std::vector<std::uint32_t>& triangles) const {
    std::vector<std::uint32_t> order;
    std::vector<std::uint8_t> seen(triangles.size(), 0);
    for (std::uint32_t start = 0; start < triangles.size(); ++start) {
      if (seen[start]) continue;
      seen[start] = 1;
      order.push_back(start);
      for (std::size_t next = order.size() - 1; next < order.size(); ++next)
        for (const std::uint32_t other : neighbours_.of(triangles[order[next]])) {
          const auto found = std::lower_bound(triangles.begin(), triangles.end(), other);
          const auto at = static_cast<std::uint32_t>(found - triangles.begin());
          if (found == triangles.end() || *found != other || seen[at]) continue;
          seen[at] = 1;
          order.push_back(at);
        }
    }
    return order;
  }

  void addChart(std::vector<std::uint32_t> triangles, const ChartShape& shape) {
    LightMapChart chart{false, false, std::move(triangles), {}, {}};
    setShape(shape, chart);
    result_.charts.push_back(std::move(chart));
  }

  void addBacks() {
    const std::size_t fronts = result_.charts.size();
    for (std::size_t c = 0; c < fronts; ++c) {
      const std::uint32_t triangle = result_.charts[c].triangles[0];
      if (!isWanted(compiled_.materials[compiled_.triangleMaterials[triangle]], true)) continue;
      LightMapChart back = result_.charts[c];
      back.back = true;
      result_.charts.push_back(std::move(back));
    }
  }

  const Scene& scene_;
  const CompiledScene& compiled_;
  const LightMapLayoutRequest& request_;
  LightMapCharts result_;
  std::vector<std::uint32_t> groups_;  ///< [triangle]
  std::vector<double> areas_;          ///< [triangle], m2
  TriangleNeighbours neighbours_;
};

/// Roughness from which on viewer/techniques/full/global_illumination.frag mixes in the mean.
constexpr float narrowestWideMetal = 0.3f;

bool isBlack(const glm::vec3& color) { return color == glm::vec3(0.0f); }

}  // namespace

double flatArea(const LightMapChart& chart) {
  double sum = 0.0;
  for (std::size_t c = 0; c < chart.corners.size(); c += 3) {
    const glm::dvec2 e(chart.corners[c + 1] - chart.corners[c]), f(chart.corners[c + 2] - chart.corners[c]);
    sum += 0.5 * std::abs(e.x * f.y - e.y * f.x);
  }
  return sum;
}

bool hasLight(const CompiledMaterial& material, bool back) {
  const bool translucent = !isBlack(material.diffuseTransmission);
  if (material.unlit || (isBlack(material.albedo) && !translucent)) return false;
  return !back || material.doubleSided || translucent;
}

bool isWideMetal(const CompiledMaterial& material) {
  return !material.unlit && isBlack(material.albedo) && material.metallic > 0.0f &&
         material.roughness > narrowestWideMetal;
}

LightMapCharts makeLightMapCharts(const Scene& scene, const CompiledScene& compiled,
                                  const LightMapLayoutRequest& request) {
  return ChartsMaker(scene, compiled, request).make();
}

namespace {

/// Price of the square of the texel count, in squared error, such that scenes of up to some sixty pieces have
/// the fewest texels. A price of the count itself would leave so few rays per texel that noise exceeds the
/// gain.
constexpr double piecesOfFewest = 60.0;
constexpr double price = 0.5 * piecesOfFewest /
                         (double(fewestUsualTexels) * double(fewestUsualTexels) * double(fewestUsualTexels));
constexpr int stepsPerOctave = 8;  // step of the counts that are tried

/// Returns the lit areas, m2, of a scene's pieces: regions, or primitives' parts of them; both sides where
/// both are lit.
std::vector<double> areasOfPieces(const CompiledScene& scene, const SurfaceRegions& regions) {
  const SurfaceRegions parts = splitByPrimitive(regions, scene);
  std::vector<double> areas(parts.count(), 0.0);
  for (std::uint32_t t = 0; t < scene.triangleCount(); ++t) {
    const CompiledMaterial& material = scene.materials[scene.triangleMaterials[t]];
    const double area = 0.5 * glm::length(geometricNormal(scene, t));
    for (const bool back : {false, true})
      if (hasLight(material, back)) areas[parts.regionOf[t]] += area;
  }
  return areas;
}

/// Returns the mean squared error with `count` texels. Pieces that are smaller than a texel have an error of
/// 1.
double squaredError(const std::vector<double>& areas, double area, double count) {
  const double texel = area / count;
  double sum = 0.0;
  for (const double piece : areas) sum += std::min(piece, texel);
  return sum / area;
}

}  // namespace

UsualTexels usualTexels(const CompiledScene& scene, const SurfaceRegions& regions) {
  const std::vector<double> pieces = areasOfPieces(scene, regions);
  UsualTexels result;
  for (const double area : pieces) result.area += area;
  if (!(result.area > 0.0)) return result;
  double least = std::numeric_limits<double>::max();
  for (int step = 0;; ++step) {
    const double count = std::round(fewestUsualTexels * std::exp2(double(step) / stepsPerOctave));
    if (count > mostUsualTexels) return result;
    const double cost = squaredError(pieces, result.area, count) + price * count * count;
    if (cost >= least) continue;
    least = cost;
    result.count = static_cast<std::uint32_t>(count);
  }
}

UsualTexels usualTexels(const CompiledScene& scene) {
  return usualTexels(scene, makeSurfaceRegions(scene, usualCreaseAngle));
}

namespace {

/// Returns the charts of requested backs that have none.
LightMapCharts backsOf(const CompiledScene& scene, const LightMapCharts& charts,
                       std::span<const std::uint8_t> met, const LightMapLayout& layout) {
  LightMapCharts backs;
  backs.texelSize = charts.texelSize;
  for (const LightMapChart& chart : charts.charts) {
    if (chart.back || layout.chartOf[scene.triangleCount() + chart.triangles[0]] != LightMapLayout::noChart)
      continue;
    if (std::none_of(chart.triangles.begin(), chart.triangles.end(),
                     [&](std::uint32_t t) { return met[t] != 0; }))
      continue;
    backs.charts.push_back(chart);
    backs.charts.back().back = true;
  }
  return backs;
}

/// Converts the texels' numbers to the map's new width.
void widen(LightMapLayout& layout, int width) {
  const auto before = static_cast<std::uint32_t>(layout.width), now = static_cast<std::uint32_t>(width);
  for (LightMapTexel& t : layout.texels) t.texel = t.texel / before * now + t.texel % before;
  layout.width = width;
}

}  // namespace

std::uint32_t addBacks(const CompiledScene& scene, const LightMapCharts& charts,
                       std::span<const std::uint8_t> met, LightMapLayout& layout) {
  if (met.empty()) return 0;
  const LightMapCharts backs = backsOf(scene, charts, met, layout);
  if (backs.charts.empty()) return 0;
  LightMapLayout below = layOutLightMap(scene, backs);
  const int width = std::max(layout.width, below.width);
  widen(layout, width);
  widen(below, width);
  const auto rows = static_cast<std::uint32_t>(layout.height);
  for (LightMapTexel texel : below.texels) {
    texel.texel += rows * static_cast<std::uint32_t>(width);
    layout.texels.push_back(texel);
  }
  for (std::size_t face = 0; face < below.chartOf.size(); ++face) {
    if (below.chartOf[face] == LightMapLayout::noChart) continue;
    layout.chartOf[face] = layout.chartCount + below.chartOf[face];
    for (std::size_t corner = 0; corner < 3; ++corner)
      layout.corners[3 * face + corner] =
          below.corners[3 * face + corner] + glm::vec2(0.0f, static_cast<float>(rows));
  }
  layout.chartCount += below.chartCount;
  layout.height += below.height;
  return below.chartCount;
}

}  // namespace prelight
