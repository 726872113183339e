#include "photon/density_surface.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <limits>

#include "base/parallel.h"
#include "photon/leaf_tree.h"
#include "scene/surface/mesh_edges.h"

namespace prelight {

namespace {

constexpr std::size_t mostDistances = std::size_t{1} << 23;  // per region: some 20 ms
constexpr double clearanceRounding = 1e-6;                   // relative to a clearance

struct Segment {
  glm::dvec3 from, to;
};

double distance(const glm::dvec3& p, const Segment& s) {
  const glm::dvec3 way = s.to - s.from;
  const double t = std::clamp(glm::dot(p - s.from, way) / glm::dot(way, way), 0.0, 1.0);
  return glm::length(p - (s.from + t * way));
}

/// Returns the triangle sides of planar regions that no triangle of the region continues, [region]. Sides
/// where more than two triangles meet are included.
std::vector<std::vector<Segment>> rims(const CompiledScene& scene, const SurfaceRegions& regions,
                                       std::span<const std::uint8_t> planar) {
  std::vector<std::vector<Segment>> rims(planar.size());
  const std::vector<EdgeSide> sides = edgeSidesOf(scene, placesOfVertices(scene));
  forEachEdge(std::span(sides), [&](std::span<const EdgeSide> edge) {
    for (const EdgeSide& side : edge) {
      const std::uint32_t region = regions.regionOf[side.triangle];
      if (planar[region] == 0) continue;
      std::ptrdiff_t same = 0, opposite = 0;
      for (const EdgeSide& other : edge)
        if (regions.regionOf[other.triangle] == region) ++(other.reversed == side.reversed ? same : opposite);
      if (same != 1 || opposite != 1)
        rims[region].push_back(
            {glm::dvec3(scene.positions[side.low]), glm::dvec3(scene.positions[side.high])});
    }
  });
  return rims;
}

float clearanceOf(const CompiledScene& scene, std::uint32_t triangle, std::span<const Segment> rim) {
  const glm::uvec3& t = scene.triangles[triangle];
  const glm::dvec3 a(scene.positions[t.x]), b(scene.positions[t.y]), c(scene.positions[t.z]);
  const glm::dvec3 centre = (a + b + c) / 3.0;
  double least = std::numeric_limits<double>::max();
  for (const Segment& segment : rim) least = std::min(least, distance(centre, segment));
  const double radius = std::max({glm::length(a - centre), glm::length(b - centre), glm::length(c - centre)});
  return static_cast<float>(std::max(0.0, (1.0 - clearanceRounding) * least - radius));
}

}  // namespace

std::vector<float> planeClearance(const CompiledScene& scene, const SurfaceRegions& regions,
                                  std::span<const std::uint8_t> planar) {
  const std::vector<std::vector<Segment>> rim = rims(scene, regions, planar);
  std::vector<std::size_t> triangles(planar.size());
  for (const std::uint32_t region : regions.regionOf) ++triangles[region];
  std::vector<float> clearance(scene.triangleCount(), 0.0f);
  parallelRanges(clearance.size(), 256, [&](std::size_t begin, std::size_t end) {
    for (std::size_t t = begin; t < end; ++t) {
      const std::uint32_t region = regions.regionOf[t];
      if (planar[region] != 0 && triangles[region] * rim[region].size() <= mostDistances)
        clearance[t] = clearanceOf(scene, static_cast<std::uint32_t>(t), rim[region]);
    }
  });
  return clearance;
}

namespace {

using device::AreaNode;
using device::AreaTriangle;
using device::LeafTree;

constexpr double rounding = 0x1p-21;  // relative rounding of transformed coordinates

struct Corners {
  std::array<glm::dvec3, 3> at;
  glm::dvec3 normal{0.0};  ///< unit; 0 for triangles without area
  double area = 0.0;
};

Corners cornersOf(const CompiledScene& scene, std::uint32_t triangle) {
  Corners corners;
  for (int k = 0; k < 3; ++k) corners.at[k] = glm::dvec3(scene.positions[scene.triangles[triangle][k]]);
  const glm::dvec3 normal = geometricNormal(scene, triangle);
  const double length = glm::length(normal);
  corners.area = 0.5 * length;
  if (length > 0.0) corners.normal = normal / length;
  return corners;
}

/// Area and moments of a leaf or of a node's subtree.
struct Sums {
  double area = 0.0;
  double moment = 0.0;
  glm::dvec3 centre{0.0};
  glm::dvec3 normal{0.0};  ///< area-weighted sum of unit normals

  /// Adds sums by the parallel axis theorem.
  void add(const Sums& other) {
    const double both = area + other.area;
    if (!(both > 0.0)) return;
    const glm::dvec3 mean = (area * centre + other.area * other.centre) / both;
    moment += area * glm::dot(centre - mean, centre - mean) + other.moment +
              other.area * glm::dot(other.centre - mean, other.centre - mean);
    centre = mean;
    area = both;
    normal += other.normal;
  }
};

Sums sumsOf(const Corners& corners) {
  const glm::dvec3 centre = (corners.at[0] + corners.at[1] + corners.at[2]) / 3.0;
  double squares = 0.0;
  for (const glm::dvec3& corner : corners.at) squares += glm::dot(corner - centre, corner - centre);
  return {corners.area, corners.area * squares / 12.0, centre, corners.area * corners.normal};
}

/// Returns for each region whether its triangles lie in the plane of the largest one.
std::vector<std::uint8_t> findPlanarRegions(const CompiledScene& scene, const SurfaceRegions& regions) {
  std::vector<std::uint32_t> largest(regions.count(), 0xffffffffu);
  std::vector<double> areas(regions.count(), -1.0);
  for (std::uint32_t t = 0; t < scene.triangleCount(); ++t) {
    const double area = cornersOf(scene, t).area;
    if (area > areas[regions.regionOf[t]]) {
      areas[regions.regionOf[t]] = area;
      largest[regions.regionOf[t]] = t;
    }
  }
  std::vector<std::uint8_t> planar(regions.count(), 1);
  for (std::uint32_t t = 0; t < scene.triangleCount(); ++t) {
    const Corners plane = cornersOf(scene, largest[regions.regionOf[t]]), corners = cornersOf(scene, t);
    if (glm::dot(plane.normal, corners.normal) < 0.0) planar[regions.regionOf[t]] = 0;
    for (const glm::dvec3& corner : corners.at) {
      const glm::dvec3 size = glm::max(glm::abs(corner), glm::abs(plane.at[0]));
      const double slack = rounding * std::max({size.x, size.y, size.z});
      if (std::abs(glm::dot(plane.normal, corner - plane.at[0])) > slack) planar[regions.regionOf[t]] = 0;
    }
  }
  return planar;
}

/// Fills the nodes of one tree from the leaves up.
class AreaTreeFiller {
 public:
  AreaTreeFiller(const CompiledScene& scene, const LeafTree& tree, std::span<const TreeItem> items,
                 DensitySurface& surface)
      : scene_(scene),
        tree_(tree),
        items_(items),
        surface_(surface),
        leafCount_(std::size_t{1} << tree.levels),
        sums_(2 * leafCount_),
        boxes_(2 * leafCount_) {}

  void fill() {
    for (std::size_t leaf = 0; leaf < leafCount_; ++leaf) fillLeaf(leaf);
    for (std::size_t node = leafCount_ - 1; node > 0; --node) {
      sums_[node] = sums_[2 * node];
      sums_[node].add(sums_[2 * node + 1]);
      boxes_[node] = unite(boxes_[2 * node], boxes_[2 * node + 1]);
    }
    for (std::size_t node = 1; node < 2 * leafCount_; ++node) write(node);
    for (std::size_t leaf = 0; leaf < leafCount_; ++leaf) spreadFrom(leaf);
  }

 private:
  AreaNode& nodeAt(std::size_t node) { return surface_.areaNodes[tree_.firstNode + node - 1]; }

  void fillLeaf(std::size_t leaf) {
    const std::size_t first = leafBegin(tree_, leaf), count = leafBegin(tree_, leaf + 1) - first;
    const std::size_t node = leafCount_ + leaf;
    nodeAt(node).triangleCount = static_cast<std::uint32_t>(count);
    for (std::size_t i = 0; i < count; ++i) {
      const std::uint32_t t = items_[first + i].index;
      const Corners corners = cornersOf(scene_, t);
      const std::size_t slot = (tree_.firstLeaf + leaf) * PRELIGHT_LEAF_TRIANGLES + i;
      AreaTriangle& triangle = surface_.triangles[slot];
      for (int k = 0; k < 3; ++k) {
        boxes_[node].grow(glm::vec3(corners.at[k]));
        triangle.normal[k] = static_cast<float>(corners.normal[k]);
        for (int axis = 0; axis < 3; ++axis)
          triangle.corners[3 * k + axis] = static_cast<float>(corners.at[k][axis]);
      }
      surface_.places[t].areaTriangle = static_cast<std::uint32_t>(slot);
      sums_[node].add(sumsOf(corners));
    }
  }

  void write(std::size_t node) {
    AreaNode& out = nodeAt(node);
    const Sums& sums = sums_[node];
    const double length = glm::length(sums.normal);
    const glm::dvec3 normal = length > 0.0 ? sums.normal / length : glm::dvec3(0, 0, 1);
    for (int k = 0; k < 3; ++k) {
      out.lower[k] = boxes_[node].lower[k];
      out.upper[k] = boxes_[node].upper[k];
      out.centre[k] = static_cast<float>(sums.centre[k]);
      out.normal[k] = static_cast<float>(normal[k]);
    }
    out.area = static_cast<float>(sums.area);
    out.moment = static_cast<float>(sums.moment);
    out.spread = length > 0.0 ? 1.0f : -1.0f;
  }

  /// Extends the normal spread of all nodes above a leaf to the normals of its triangles.
  void spreadFrom(std::size_t leaf) {
    const std::size_t first = (tree_.firstLeaf + leaf) * PRELIGHT_LEAF_TRIANGLES;
    const std::size_t count = nodeAt(leafCount_ + leaf).triangleCount;
    for (std::size_t node = leafCount_ + leaf; node > 0; node /= 2) {
      AreaNode& out = nodeAt(node);
      for (std::size_t i = 0; i < count; ++i) {
        const float* normal = surface_.triangles[first + i].normal;
        const float cosine =
            out.normal[0] * normal[0] + out.normal[1] * normal[1] + out.normal[2] * normal[2];
        out.spread = std::min(out.spread, cosine);
      }
    }
  }

  const CompiledScene& scene_;
  const LeafTree& tree_;
  std::span<const TreeItem> items_;
  DensitySurface& surface_;
  std::size_t leafCount_;
  std::vector<Sums> sums_;  ///< [node], the root is 1
  std::vector<Box> boxes_;
};

}  // namespace

DensitySurface makeDensitySurface(const CompiledScene& scene, const SurfaceRegions& regions) {
  assert(regions.regionOf.size() == scene.triangleCount());
  std::vector<TreeRange> ranges(regions.count());
  for (const std::uint32_t region : regions.regionOf) ++ranges[region].count;
  std::size_t first = 0;
  for (TreeRange& range : ranges) {
    range.first = first;
    first += range.count;
  }
  std::vector<TreeItem> items(scene.triangleCount());
  std::vector<std::size_t> next;
  for (const TreeRange& range : ranges) next.push_back(range.first);
  for (std::uint32_t t = 0; t < scene.triangleCount(); ++t)
    items[next[regions.regionOf[t]]++] = {glm::vec3(sumsOf(cornersOf(scene, t)).centre), t};

  const LeafTrees trees = makeLeafTrees(items, ranges, PRELIGHT_LEAF_TRIANGLES);
  DensitySurface surface;
  surface.areaTrees = trees.trees;
  surface.areaNodes.resize(trees.nodeCount);
  surface.triangles.resize(std::size_t{trees.leafCount} * PRELIGHT_LEAF_TRIANGLES);
  const std::vector<std::uint8_t> planar = findPlanarRegions(scene, regions);
  surface.places.resize(scene.triangleCount());
  const std::vector<float> clearance = planeClearance(scene, regions, planar);
  for (std::uint32_t t = 0; t < scene.triangleCount(); ++t) {
    surface.places[t].region =
        regions.regionOf[t] | (planar[regions.regionOf[t]] != 0 ? PRELIGHT_PLANAR_REGION : 0u);
    surface.places[t].clearance = clearance[t];
  }
  parallelRanges(ranges.size(), 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t r = begin; r < end; ++r)
      AreaTreeFiller(scene, trees.trees[r], std::span(items).subspan(ranges[r].first, ranges[r].count),
                     surface)
          .fill();
  });
  return surface;
}

void followDensitySurface(DensitySurface& surface, const CompiledScene& scene,
                          std::span<const std::uint32_t> regions) {
  std::vector<std::uint32_t> placeOf(surface.regionCount(), 0xffffffffu);
  for (std::size_t i = 0; i < regions.size(); ++i) placeOf[regions[i]] = static_cast<std::uint32_t>(i);
  std::vector<std::vector<TreeItem>> items(regions.size());
  for (std::uint32_t t = 0; t < scene.triangleCount(); ++t) {
    const std::uint32_t place = placeOf[surface.places[t].region & ~PRELIGHT_PLANAR_REGION];
    if (place != 0xffffffffu) items[place].push_back({glm::vec3(0.0f), t});
  }
  for (std::size_t i = 0; i < regions.size(); ++i) {
    std::sort(items[i].begin(), items[i].end(), [&](const TreeItem& a, const TreeItem& b) {
      return surface.places[a.index].areaTriangle < surface.places[b.index].areaTriangle;
    });
    AreaTreeFiller(scene, surface.areaTrees[regions[i]], items[i], surface).fill();
  }
}

}  // namespace prelight
