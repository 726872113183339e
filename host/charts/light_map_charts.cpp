#include "charts/light_map_charts.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numeric>
#include <optional>

#include "charts/chart_growth.h"
#include "charts/chart_shape.h"
#include "scene/gltf/charts.h"

namespace prelight {

namespace {

constexpr double leastTexels = 4.0;  // pieces of less area than these join others
constexpr int mostLayers = 24;       // of triangles over one another; those below get charts of their own
constexpr double mostTexels = 0.5 * mostLightMapSide * mostLightMapSide;  // that are chosen
constexpr double mostFileStretch = 4.0;  // of areas and of sides within an island of TEXCOORD_1

struct Piece {
  std::vector<std::uint32_t> triangles;
  glm::dvec3 axis{0.0};
};

/// Two unit vectors that span the plane of a normal.
std::array<glm::dvec3, 2> planeOf(const glm::dvec3& normal) {
  const glm::dvec3 helper = std::abs(normal.x) < 0.7 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0);
  const glm::dvec3 u = glm::normalize(glm::cross(helper, normal));
  return {u, glm::cross(normal, u)};
}

/// A texel size at which charts take about as many texels as asked for: those of small charts and along edges
/// come on top of the surface's area. At most twice the size that the area alone gives, or many small charts
/// would take all from the large ones; but no chart longer than half the largest map.
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
    result_.texelSize = request_.texelSize > 0.0 ? request_.texelSize
                                                 : std::sqrt(result_.area / std::max(1u, request_.texels));
    for (std::size_t p = 0; p < compiled_.primitives.size(); ++p) takeFileIslands(p);
    neighbours_ = neighboursOf(compiled_, groups_);
    const SurfaceRegions regions = makeSurfaceRegions(compiled_, request_.creaseAngle);
    const GrownCharts grown = growCharts(compiled_, regions, groups_, neighbours_,
                                         leastTexels * result_.texelSize * result_.texelSize);
    std::vector<Piece> pieces(grown.axes.size());
    for (std::uint32_t t = 0; t < compiled_.triangleCount(); ++t)
      if (grown.chartOf[t] != noGroup) pieces[grown.chartOf[t]].triangles.push_back(t);
    for (std::size_t c = 0; c < pieces.size(); ++c) {
      pieces[c].axis = grown.axes[c];
      if (!pieces[c].triangles.empty()) project(std::move(pieces[c]));
    }
    addBacks();
    if (request_.texelSize <= 0.0) result_.texelSize = fittingSize(result_, request_.texels);
    return std::move(result_);
  }

 private:
  bool isWanted(const CompiledMaterial& material, bool back) const {
    if (hasLight(material, back)) return true;
    return request_.wideMetals && isWideMetal(material) && (!back || material.doubleSided);
  }

  /// Groups are primitives, apart for triangles with and without a back.
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

  const Primitive* primitiveOf(const PrimitiveRange& range) const {
    if (range.mesh < 0 || static_cast<std::size_t>(range.mesh) >= scene_.meshes.size()) return nullptr;
    const auto& primitives = scene_.meshes[static_cast<std::size_t>(range.mesh)].primitives;
    return static_cast<std::size_t>(range.primitive) < primitives.size()
               ? &primitives[static_cast<std::size_t>(range.primitive)]
               : nullptr;
  }

  void takeFileIslands(std::size_t p) {
    const PrimitiveRange& range = compiled_.primitives[p];
    const Primitive* primitive = primitiveOf(range);
    if (primitive == nullptr || range.triangleCount == 0 || groups_[range.firstTriangle] == noGroup) return;
    const std::vector<glm::vec2>& coords = primitive->texCoords1;
    if (coords.size() != range.vertexCount) return;
    const std::vector<glm::uvec3> triangles = trianglesOf(compiled_, range);
    const auto [good, fresh] = usable_.try_emplace({range.mesh, range.primitive}, false);
    if (fresh) good->second = whyNoChart(coords, triangles).empty();
    if (!good->second) return;
    std::vector<LightMapChart> charts;
    for (const std::vector<std::uint32_t>& island : islandsOf(coords, triangles)) {
      std::optional<LightMapChart> chart = fileChart(p, coords, triangles, island);
      if (!chart) return;
      charts.push_back(std::move(*chart));
    }
    for (LightMapChart& chart : charts) {
      for (const std::uint32_t t : chart.triangles) groups_[t] = noGroup;
      result_.charts.push_back(std::move(chart));
    }
  }

  /// Triangles that share places of the texture, island by island.
  static std::vector<std::vector<std::uint32_t>> islandsOf(const std::vector<glm::vec2>& coords,
                                                           const std::vector<glm::uvec3>& triangles) {
    std::map<std::pair<float, float>, std::uint32_t> placeOf;
    std::vector<std::uint32_t> places, parent;
    for (const glm::vec2& uv : coords) {
      const auto [found, fresh] =
          placeOf.try_emplace({uv.x, uv.y}, static_cast<std::uint32_t>(parent.size()));
      if (fresh) parent.push_back(found->second);
      places.push_back(found->second);
    }
    const auto root = [&](std::uint32_t i) {
      while (parent[i] != i) i = parent[i] = parent[parent[i]];
      return i;
    };
    for (const glm::uvec3& t : triangles)
      for (int corner = 1; corner < 3; ++corner) {
        const std::uint32_t a = root(places[t.x]), b = root(places[t[corner]]);
        parent[std::max(a, b)] = std::min(a, b);
      }
    std::map<std::uint32_t, std::vector<std::uint32_t>> islands;
    for (std::uint32_t t = 0; t < triangles.size(); ++t) islands[root(places[triangles[t].x])].push_back(t);
    std::vector<std::vector<std::uint32_t>> result;
    for (auto& [key, island] : islands) result.push_back(std::move(island));
    return result;
  }

  /// Nothing when it is stretched too much, or covers itself.
  std::optional<LightMapChart> fileChart(std::size_t p, const std::vector<glm::vec2>& coords,
                                         const std::vector<glm::uvec3>& triangles,
                                         const std::vector<std::uint32_t>& island) const {
    LightMapChart chart{false, true, {}, {}, {}};
    std::vector<glm::dvec2> corners;
    double area = 0.0, flat = 0.0;
    std::vector<std::array<double, 2>> each;
    double skewed = 0.0;  // surface whose longer side is stretched much more than the shorter
    for (const std::uint32_t i : island) {
      chart.triangles.push_back(compiled_.primitives[p].firstTriangle + i);
      std::array<glm::dvec2, 3> c{};
      for (int corner = 0; corner < 3; ++corner) c[corner] = glm::dvec2(coords[triangles[i][corner]]);
      corners.insert(corners.end(), c.begin(), c.end());
      const glm::dvec2 e = c[1] - c[0], f = c[2] - c[0];
      each.push_back({areas_[chart.triangles.back()], 0.5 * std::abs(e.x * f.y - e.y * f.x)});
      if (anisotropy(chart.triangles.back(), c) > mostFileStretch) skewed += each.back()[0];
      area += each.back()[0];
      flat += each.back()[1];
    }
    if (!(flat > 0.0)) return std::nullopt;
    double stretched = skewed;
    for (const auto& [own, laid] : each)
      if (laid * area > mostFileStretch * own * flat || laid * area * mostFileStretch < own * flat)
        stretched += own;
    if (stretched > 0.05 * area) return std::nullopt;
    const ChartShape shape = shapeOf(std::move(corners), area);
    std::vector<std::uint32_t> order(island.size());
    std::iota(order.begin(), order.end(), 0u);
    const std::vector<std::uint8_t> free = withoutOverlap(shape, order);
    if (std::count(free.begin(), free.end(), 0) > 0) return std::nullopt;
    setShape(shape, chart);
    return chart;
  }

  /// Ratio of the lengths that a triangle's circle becomes on the texture: of singular values of the map.
  double anisotropy(std::uint32_t triangle, const std::array<glm::dvec2, 3>& c) const {
    const glm::uvec3& t = compiled_.triangles[triangle];
    const glm::dvec3 a(compiled_.positions[t.x]), e = glm::dvec3(compiled_.positions[t.y]) - a,
                                                  f = glm::dvec3(compiled_.positions[t.z]) - a;
    const double length = glm::length(e);
    if (!(length > 0.0)) return 1.0;
    const double along = glm::dot(f, e) / length, across = 2.0 * areas_[triangle] / length;
    const glm::dvec2 u = (c[1] - c[0]) / length, v = (c[2] - c[0] - along * u) / across;
    const double sum = glm::dot(u, u) + glm::dot(v, v), product = std::abs(u.x * v.y - u.y * v.x);
    const double root = std::sqrt(std::max(0.0, sum * sum - 4.0 * product * product));
    const double least = 0.5 * (sum - root);
    return least > 0.0 ? std::sqrt(0.5 * (sum + root) / least) : 1e30;
  }

  static void setShape(const ChartShape& shape, LightMapChart& chart) {
    chart.corners.assign(shape.corners.begin(), shape.corners.end());
    chart.size = shape.size;
  }

  /// Layer by layer where triangles come to lie over one another.
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

  /// Places in a list of triangles, each after one that it hangs together with.
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
  std::map<std::pair<int, int>, bool> usable_;  ///< by mesh and primitive: TEXCOORD_1 makes a chart
};

/// Roughness from which on viewer/shaders/global_illumination.frag mixes the mean in.
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

}  // namespace prelight
