#include "charts/chart_growth.h"

#include <algorithm>
#include <numeric>
#include <queue>
#include <tuple>

#include "scene/surface/mesh_edges.h"

namespace prelight {

namespace {

constexpr double growthCosine = 0.6;  // for growing charts; triangles that join later may lean farther
constexpr int relaxations = 2;        // rounds in which seeds move to the centres of their charts
constexpr double thin = 1e-4;         // ratio of a sliver's height to its longest side; its lean is ignored

class ChartGrower {
 public:
  ChartGrower(const CompiledScene& scene, const SurfaceRegions& regions,
              std::span<const std::uint32_t> groups, const TriangleNeighbours& neighbours)
      : scene_(scene), regions_(regions), groups_(groups), neighbours_(neighbours) {
    charts_.chartOf.assign(scene.triangleCount(), noGroup);
    for (std::uint32_t t = 0; t < scene.triangleCount(); ++t) addTriangle(t);
  }

  GrownCharts grow(double leastArea) {
    takeFlatRegions();
    open_ = charts_.chartOf;
    for (int round = 0;; ++round) {
      seedTheRest();
      if (round == relaxations) break;
      relax();
    }
    joinSmall(leastArea);
    return std::move(charts_);
  }

 private:
  struct Candidate {
    double cost = 0.0;
    std::uint32_t triangle = 0;
    std::uint32_t chart = 0;

    bool operator<(const Candidate& other) const {  // the candidate with the least cost is on top
      return std::tie(cost, triangle, chart) > std::tie(other.cost, other.triangle, other.chart);
    }
  };

  void addTriangle(std::uint32_t t) {
    const glm::dvec3 normal = geometricNormal(scene_, t);
    const double length = glm::length(normal);
    areas_.push_back(0.5 * length);
    normals_.push_back(length > 0.0 ? normal / length : glm::dvec3(0.0, 1.0, 0.0));
    double longest = 0.0;
    for (int corner = 0; corner < 3; ++corner)
      longest =
          std::max(longest, double(glm::distance(scene_.positions[scene_.triangles[t][corner]],
                                                 scene_.positions[scene_.triangles[t][(corner + 1) % 3]])));
    sliver_.push_back(!(length > thin * longest * longest));
  }

  bool fits(std::uint32_t t, const glm::dvec3& axis, double leastCosine) const {
    return sliver_[t] != 0 || glm::dot(normals_[t], axis) >= leastCosine;
  }

  std::uint32_t addChart(const glm::dvec3& axis) {
    charts_.axes.push_back(axis);
    return static_cast<std::uint32_t>(charts_.axes.size() - 1);
  }

  /// Returns [chart] the directions of the sums of normals.
  static std::vector<glm::dvec3> normalised(std::vector<glm::dvec3> sums) {
    for (glm::dvec3& sum : sums) {
      const double length = glm::length(sum);
      sum = length > 0.0 ? sum / length : glm::dvec3(0.0);
    }
    return sums;
  }

  /// Makes one chart of each group's part of a region if it leans little from its mean normal.
  void takeFlatRegions() {
    std::vector<std::pair<std::uint64_t, std::uint32_t>> parts;  // region and group, triangle
    for (std::uint32_t t = 0; t < scene_.triangleCount(); ++t)
      if (groups_[t] != noGroup)
        parts.emplace_back(std::uint64_t{regions_.regionOf[t]} << 32 | groups_[t], t);
    std::sort(parts.begin(), parts.end());
    for (std::size_t first = 0, end = 0; first < parts.size(); first = end) {
      glm::dvec3 sum(0.0);
      for (end = first; end < parts.size() && parts[end].first == parts[first].first; ++end)
        sum += areas_[parts[end].second] * normals_[parts[end].second];
      const glm::dvec3 axis = normalised({sum})[0];
      bool flat = true;
      for (std::size_t i = first; i < end && flat; ++i) flat = fits(parts[i].second, axis, growthCosine);
      if (!flat || axis == glm::dvec3(0.0)) continue;
      const std::uint32_t chart = addChart(axis);
      for (std::size_t i = first; i < end; ++i) charts_.chartOf[parts[i].second] = chart;
    }
  }

  void offer(std::uint32_t t, std::uint32_t chart) {
    if (charts_.chartOf[t] != noGroup || !fits(t, charts_.axes[chart], growthCosine)) return;
    queue_.push({1.0 - glm::dot(normals_[t], charts_.axes[chart]), t, chart});
  }

  void flood() {
    while (!queue_.empty()) {
      const Candidate next = queue_.top();
      queue_.pop();
      if (charts_.chartOf[next.triangle] != noGroup) continue;
      charts_.chartOf[next.triangle] = next.chart;
      for (const std::uint32_t other : neighbours_.of(next.triangle))
        if (regions_.regionOf[other] == regions_.regionOf[next.triangle]) offer(other, next.chart);
    }
  }

  /// Grows charts from the largest triangle without one, until all have one.
  void seedTheRest() {
    std::vector<std::uint32_t> order;
    for (std::uint32_t t = 0; t < scene_.triangleCount(); ++t)
      if (groups_[t] != noGroup && charts_.chartOf[t] == noGroup) order.push_back(t);
    std::stable_sort(order.begin(), order.end(),
                     [&](std::uint32_t a, std::uint32_t b) { return areas_[a] > areas_[b]; });
    for (const std::uint32_t t : order) {
      if (charts_.chartOf[t] != noGroup) continue;
      queue_.push({0.0, t, addChart(normals_[t])});
      flood();
    }
  }

  /// Grows all charts of regions that are not flat anew, from the triangles that represent them best.
  void relax() {
    std::vector<glm::dvec3> sums(charts_.axes.size(), glm::dvec3(0.0));
    for (std::uint32_t t = 0; t < scene_.triangleCount(); ++t)
      if (isOpen(t)) sums[charts_.chartOf[t]] += areas_[t] * normals_[t];
    const std::vector<glm::dvec3> means = normalised(sums);
    std::vector<std::uint32_t> best(charts_.axes.size(), noGroup);
    for (std::uint32_t t = 0; t < scene_.triangleCount(); ++t) {
      if (!isOpen(t)) continue;
      const std::uint32_t chart = charts_.chartOf[t];
      if (best[chart] == noGroup ||
          glm::dot(normals_[t], means[chart]) > glm::dot(normals_[best[chart]], means[chart]))
        best[chart] = t;
    }
    charts_.chartOf = open_;
    for (std::uint32_t chart = 0; chart < best.size(); ++chart) {
      if (best[chart] == noGroup) continue;
      charts_.axes[chart] = normals_[best[chart]];
      queue_.push({0.0, best[chart], chart});
    }
    flood();
  }

  /// Returns true for triangles that takeFlatRegions has not settled.
  bool isOpen(std::uint32_t t) const { return groups_[t] != noGroup && open_[t] == noGroup; }

  /// Joins small charts, the smallest first, to the neighbour from whose plane they lean least.
  void joinSmall(double leastArea) {
    std::vector<double> areas(charts_.axes.size(), 0.0);
    std::vector<std::vector<std::uint32_t>> members(charts_.axes.size());
    for (std::uint32_t t = 0; t < scene_.triangleCount(); ++t) {
      if (charts_.chartOf[t] == noGroup) continue;
      areas[charts_.chartOf[t]] += areas_[t];
      members[charts_.chartOf[t]].push_back(t);
    }
    std::vector<std::uint32_t> order(areas.size());
    std::iota(order.begin(), order.end(), 0u);
    std::stable_sort(order.begin(), order.end(),
                     [&](std::uint32_t a, std::uint32_t b) { return areas[a] < areas[b]; });
    for (const std::uint32_t chart : order) {
      if (!(areas[chart] < leastArea) || members[chart].empty()) continue;
      const std::uint32_t into = neighbourFor(chart, members[chart]);
      if (into == noGroup) continue;
      for (const std::uint32_t t : members[chart]) charts_.chartOf[t] = into;
      // The members of a joined chart move on with it only while the joint chart is small itself.
      if (areas[into] < leastArea)
        members[into].insert(members[into].end(), members[chart].begin(), members[chart].end());
      areas[into] += areas[chart];
      members[chart].clear();
    }
  }

  std::uint32_t neighbourFor(std::uint32_t chart, std::span<const std::uint32_t> members) const {
    std::vector<std::uint32_t> others;
    for (const std::uint32_t t : members)
      for (const std::uint32_t neighbour : neighbours_.of(t))
        if (charts_.chartOf[neighbour] != chart) others.push_back(charts_.chartOf[neighbour]);
    std::sort(others.begin(), others.end());
    others.erase(std::unique(others.begin(), others.end()), others.end());
    std::uint32_t best = noGroup;
    double bestCosine = leastChartCosine;
    for (const std::uint32_t other : others) {
      double least = 1.0;
      for (const std::uint32_t t : members)
        if (!sliver_[t]) least = std::min(least, glm::dot(normals_[t], charts_.axes[other]));
      if (least < bestCosine || (best != noGroup && least == bestCosine)) continue;
      best = other;
      bestCosine = least;
    }
    return best;
  }

  const CompiledScene& scene_;
  const SurfaceRegions& regions_;
  std::span<const std::uint32_t> groups_;
  const TriangleNeighbours& neighbours_;
  GrownCharts charts_;
  std::vector<double> areas_;         ///< [triangle], m2
  std::vector<glm::dvec3> normals_;   ///< [triangle], unit
  std::vector<std::uint8_t> sliver_;  ///< [triangle]
  std::vector<std::uint32_t> open_;   ///< [triangle] its chart in a flat region, or noGroup
  std::priority_queue<Candidate> queue_;
};

}  // namespace

TriangleNeighbours neighboursOf(const CompiledScene& scene, std::span<const std::uint32_t> groups) {
  std::vector<std::pair<std::uint32_t, std::uint32_t>> pairs;
  forEachContinuation(scene, [&](const EdgeSide& a, const EdgeSide& b) {
    if (groups[a.triangle] == noGroup || groups[a.triangle] != groups[b.triangle]) return;
    pairs.emplace_back(a.triangle, b.triangle);
    pairs.emplace_back(b.triangle, a.triangle);
  });
  std::sort(pairs.begin(), pairs.end());
  pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
  TriangleNeighbours neighbours;
  neighbours.rowStart.assign(scene.triangleCount() + 1, 0);
  for (const auto& [row, column] : pairs) {
    ++neighbours.rowStart[row + 1];
    neighbours.columns.push_back(column);
  }
  std::partial_sum(neighbours.rowStart.begin(), neighbours.rowStart.end(), neighbours.rowStart.begin());
  return neighbours;
}

GrownCharts growCharts(const CompiledScene& scene, const SurfaceRegions& regions,
                       std::span<const std::uint32_t> groups, const TriangleNeighbours& neighbours,
                       double leastArea) {
  return ChartGrower(scene, regions, groups, neighbours).grow(leastArea);
}

}  // namespace prelight
