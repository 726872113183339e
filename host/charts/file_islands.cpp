#include "charts/file_islands.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <map>
#include <numeric>
#include <optional>
#include <tuple>

#include "charts/chart_shape.h"
#include "scene/gltf/charts.h"
#include "scene/surface/triangles.h"

namespace prelight {

namespace {

// Bound of the stretch of areas and of sides, relative to an island's mean.
constexpr double mostStretch = 4.0;
constexpr double mostStretchedArea = 0.05;  // share of an island that may be stretched more
constexpr double mostCuts = 1.25;           // ratio to the cuts of charts made without the file's coordinates

/// The map from lengths on the surface to lengths on the texture: K K^T, where K maps vectors of a triangle's
/// plane (m) to the texture. It is symmetric: xx, xy, yy.
struct TextureMetric {
  double xx = 0.0, xy = 0.0, yy = 0.0;

  void add(const TextureMetric& other, double weight) {
    xx += weight * other.xx;
    xy += weight * other.xy;
    yy += weight * other.yy;
  }
  double determinant() const { return xx * yy - xy * xy; }
};

/// Returns the square roots of a metric's eigenvalues: the greatest and the least length on the texture per
/// metre.
std::array<double, 2> stretchesOf(const TextureMetric& m) {
  const double half = 0.5 * (m.xx + m.yy), root = std::hypot(0.5 * (m.xx - m.yy), m.xy);
  return {std::sqrt(half + root), std::sqrt(std::max(0.0, half - root))};
}

/// Returns the symmetric matrix M^(-1/2), which makes lengths on the texture equal to those on the surface in
/// the mean. By the Cayley-Hamilton theorem the root of M is (M + sqrt(det M)) / sqrt(trace M + 2 sqrt(det
/// M)).
glm::dmat2 undoing(const TextureMetric& m) {
  const double area = std::sqrt(m.determinant()), side = std::sqrt(m.xx + m.yy + 2.0 * area);
  const double a = (m.xx + area) / side, b = m.xy / side, d = (m.yy + area) / side;
  return glm::dmat2(d, -b, -b, a) / (a * d - b * b);
}

struct Island {
  std::vector<std::uint32_t> triangles;  ///< indices in the primitive
  std::vector<glm::dvec2> corners;       ///< [triangle][3], on the texture, later flattened
  std::vector<double> areas;             ///< [triangle], m2
};

/// Returns the metric of a triangle; none for a triangle without area. `corners`: its corners on the texture.
std::optional<TextureMetric> metricOf(const CompiledScene& scene, std::uint32_t triangle,
                                      const glm::dvec2* corners) {
  const glm::uvec3& t = scene.triangles[triangle];
  const glm::dvec3 a(scene.positions[t.x]), e = glm::dvec3(scene.positions[t.y]) - a,
                                            f = glm::dvec3(scene.positions[t.z]) - a;
  const double length = glm::length(e);
  if (!(length > 0.0)) return std::nullopt;
  const double along = glm::dot(f, e) / length, across = glm::length(glm::cross(e, f)) / length;
  if (!(across > 0.0)) return std::nullopt;
  const glm::dvec2 u = (corners[1] - corners[0]) / length, v = (corners[2] - corners[0] - along * u) / across;
  return TextureMetric{u.x * u.x + v.x * v.x, u.x * u.y + v.x * v.y, u.y * u.y + v.y * v.y};
}

/// Returns the triangles of each island: those connected by shared positions on the texture.
std::vector<std::vector<std::uint32_t>> islandsOf(const std::vector<glm::vec2>& coords,
                                                  const std::vector<glm::uvec3>& triangles) {
  std::map<std::pair<float, float>, std::uint32_t> placeOf;
  std::vector<std::uint32_t> places, parent;
  for (const glm::vec2& uv : coords) {
    const auto [found, fresh] = placeOf.try_emplace({uv.x, uv.y}, static_cast<std::uint32_t>(parent.size()));
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

class IslandFlattener {
 public:
  IslandFlattener(const CompiledScene& scene, const PrimitiveRange& range,
                  const std::vector<glm::vec2>& coords, const std::vector<glm::uvec3>& triangles)
      : scene_(scene), range_(range), coords_(coords), triangles_(triangles) {}

  /// Adds an island's chart, or returns why it makes none.
  std::string addChart(const std::vector<std::uint32_t>& triangles,
                       std::vector<LightMapChart>& charts) const {
    Island island = gather(triangles);
    const double area = std::accumulate(island.areas.begin(), island.areas.end(), 0.0);
    if (!layFlat(area, island)) return "has islands without area";
    if (stretchedArea(area, island) > mostStretchedArea * area)
      return fmt::format("stretches some of the surface more than {:g} times as much as the rest",
                         mostStretch);
    const ChartShape shape = shapeOf(std::move(island.corners), area);
    std::vector<std::uint32_t> order(triangles.size());
    std::iota(order.begin(), order.end(), 0u);
    const std::vector<std::uint8_t> free = withoutOverlap(shape, order);
    if (std::count(free.begin(), free.end(), 0) > 0) return "has triangles that overlap";
    LightMapChart chart{false, true, {}, {}, shape.size};
    for (const std::uint32_t t : triangles) chart.triangles.push_back(range_.firstTriangle + t);
    chart.corners.assign(shape.corners.begin(), shape.corners.end());
    charts.push_back(std::move(chart));
    return {};
  }

 private:
  Island gather(const std::vector<std::uint32_t>& triangles) const {
    Island island{triangles, {}, {}};
    for (const std::uint32_t t : triangles) {
      for (int corner = 0; corner < 3; ++corner) island.corners.emplace_back(coords_[triangles_[t][corner]]);
      island.areas.push_back(0.5 * glm::length(geometricNormal(scene_, range_.firstTriangle + t)));
    }
    return island;
  }

  std::optional<TextureMetric> metricAt(const Island& island, std::size_t i) const {
    return metricOf(scene_, range_.firstTriangle + island.triangles[i], &island.corners[3 * i]);
  }

  /// Removes the mean stretch; returns false where the island has no area on the texture.
  bool layFlat(double area, Island& island) const {
    TextureMetric mean;
    for (std::size_t i = 0; i < island.triangles.size(); ++i)
      if (const auto metric = metricAt(island, i)) mean.add(*metric, island.areas[i] / area);
    if (!(mean.determinant() > 1e-12 * (mean.xx + mean.yy) * (mean.xx + mean.yy))) return false;
    const glm::dmat2 flat = undoing(mean);
    for (glm::dvec2& corner : island.corners) corner = flat * corner;
    return true;
  }

  /// Returns the area of surface whose area or sides are stretched much more or less than the rest.
  double stretchedArea(double area, const Island& island) const {
    double flat = 0.0, stretched = 0.0;
    std::vector<double> laid;
    for (std::size_t i = 0; i < island.triangles.size(); ++i) {
      const glm::dvec2* c = &island.corners[3 * i];
      laid.push_back(0.5 * std::abs(cross(c[1] - c[0], c[2] - c[0])));
      flat += laid.back();
    }
    for (std::size_t i = 0; i < island.triangles.size(); ++i) {
      const double ratio = laid[i] * area, even = island.areas[i] * flat;
      bool much = ratio > mostStretch * even || mostStretch * ratio < even;
      if (const auto metric = metricAt(island, i); metric && !much) {
        const auto [most, least] = stretchesOf(*metric);
        much = most > mostStretch * least;
      }
      if (much) stretched += island.areas[i];
    }
    return stretched;
  }

  const CompiledScene& scene_;
  const PrimitiveRange& range_;
  const std::vector<glm::vec2>& coords_;
  const std::vector<glm::uvec3>& triangles_;
};

/// The charts of a primitive, or the reason why its coordinates make none.
struct FileCharts {
  std::vector<LightMapChart> charts;
  std::string reason;
};

class FileIslands {
 public:
  FileIslands(const Scene& scene, const CompiledScene& compiled) : scene_(scene), compiled_(compiled) {}

  /// Returns neither charts nor a reason where the primitive has no coordinates.
  FileCharts chartsOf(const PrimitiveRange& range) {
    const Primitive* primitive = primitiveOf(range);
    if (primitive == nullptr || primitive->texCoords1.size() != range.vertexCount) return {};
    const std::vector<glm::vec2>& coords = primitive->texCoords1;
    const std::vector<glm::uvec3> triangles = trianglesOf(compiled_, range);
    const auto [known, fresh] = reasons_.try_emplace({range.mesh, range.primitive});
    if (fresh) known->second = whyNoChart(coords, triangles);
    if (!known->second.empty()) return {{}, known->second};
    FileCharts result;
    const IslandFlattener flattener(compiled_, range, coords, triangles);
    for (const std::vector<std::uint32_t>& island : islandsOf(coords, triangles)) {
      const std::string reason = flattener.addChart(island, result.charts);
      if (!reason.empty()) return {{}, reason};
    }
    return result;
  }

 private:
  const Primitive* primitiveOf(const PrimitiveRange& range) const {
    if (range.mesh < 0 || static_cast<std::size_t>(range.mesh) >= scene_.meshes.size()) return nullptr;
    const auto& primitives = scene_.meshes[static_cast<std::size_t>(range.mesh)].primitives;
    return static_cast<std::size_t>(range.primitive) < primitives.size()
               ? &primitives[static_cast<std::size_t>(range.primitive)]
               : nullptr;
  }

  const Scene& scene_;
  const CompiledScene& compiled_;
  std::map<std::pair<int, int>, std::string> reasons_;  ///< whyNoChart(), by mesh and primitive
};

/// Returns [triangle] the primitive to which it belongs.
std::vector<std::uint32_t> primitivesOfTriangles(const CompiledScene& scene) {
  std::vector<std::uint32_t> primitives(scene.triangleCount(), 0);
  for (std::uint32_t p = 0; p < scene.primitives.size(); ++p)
    std::fill_n(primitives.begin() + scene.primitives[p].firstTriangle, scene.primitives[p].triangleCount, p);
  return primitives;
}

/// Returns an empty string where a file's charts have hardly more cuts than `own`, indices in `all`;
/// otherwise the reason.
std::string whyNotAsFewCuts(std::span<const LightMapChart> file, std::span<const LightMapChart> all,
                            std::span<const std::size_t> own) {
  double cuts = 0.0, ownCuts = 0.0;
  for (const LightMapChart& chart : file) cuts += cutLength(chart);
  for (const std::size_t c : own) ownCuts += cutLength(all[c]);
  if (cuts <= mostCuts * ownCuts) return {};
  return fmt::format("cuts the surface into {} pieces, along edges {:.3g} times as long as necessary",
                     file.size(), cuts / ownCuts);
}

}  // namespace

void preferFileIslands(const Scene& scene, const CompiledScene& compiled, LightMapCharts& charts) {
  const std::vector<std::uint32_t> primitiveOf = primitivesOfTriangles(compiled);
  std::vector<std::vector<std::size_t>> own(compiled.primitives.size());  // indices in charts.charts
  for (std::size_t c = 0; c < charts.charts.size(); ++c)
    own[primitiveOf[charts.charts[c].triangles[0]]].push_back(c);
  FileIslands islands(scene, compiled);
  std::vector<std::vector<LightMapChart>> file(own.size());
  for (std::size_t p = 0; p < own.size(); ++p) {
    if (own[p].empty()) continue;
    FileCharts found = islands.chartsOf(compiled.primitives[p]);
    if (!found.charts.empty()) found.reason = whyNotAsFewCuts(found.charts, charts.charts, own[p]);
    if (found.reason.empty())
      file[p] = std::move(found.charts);
    else if (compiled.primitives[p].instance == 0)
      charts.replaced.push_back({compiled.primitives[p].name, found.reason});
  }
  std::vector<LightMapChart> chosen;
  for (std::size_t c = 0; c < charts.charts.size(); ++c) {
    const std::uint32_t p = primitiveOf[charts.charts[c].triangles[0]];
    if (file[p].empty())
      chosen.push_back(std::move(charts.charts[c]));
    else if (c == own[p].front())
      std::move(file[p].begin(), file[p].end(), std::back_inserter(chosen));
  }
  charts.charts = std::move(chosen);
}

std::string replacedText(const std::vector<ReplacedCoords>& replaced) {
  constexpr std::size_t mostNamed = 3;
  if (replaced.empty()) return {};
  const auto one = [](const ReplacedCoords& coords) {
    return fmt::format("\"{}\" {}", coords.name, coords.reason);
  };
  std::string text = fmt::format("own charts in place of TEXCOORD_1: that of {}", one(replaced[0]));
  for (std::size_t i = 1; i < std::min(mostNamed, replaced.size()); ++i) text += "; of " + one(replaced[i]);
  if (replaced.size() > mostNamed) text += fmt::format("; and {} more", replaced.size() - mostNamed);
  return text;
}

double cutLength(const LightMapChart& chart) {
  using Edge = std::tuple<float, float, float, float>;
  std::vector<Edge> edges;
  for (std::size_t first = 0; first < chart.corners.size(); first += 3)
    for (std::size_t k = 0; k < 3; ++k) {
      glm::vec2 a = chart.corners[first + k], b = chart.corners[first + (k + 1) % 3];
      if (std::tie(b.x, b.y) < std::tie(a.x, a.y)) std::swap(a, b);
      edges.emplace_back(a.x, a.y, b.x, b.y);
    }
  std::sort(edges.begin(), edges.end());
  double sum = 0.0;
  for (std::size_t first = 0, end = 0; first < edges.size(); first = end) {
    for (end = first; end < edges.size() && edges[end] == edges[first];) ++end;
    const auto [ax, ay, bx, by] = edges[first];
    if (end - first == 1) sum += std::hypot(double(bx) - ax, double(by) - ay);
  }
  return sum;
}

}  // namespace prelight
