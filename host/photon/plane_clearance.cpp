#include "photon/plane_clearance.h"

#include <algorithm>
#include <limits>

#include "base/parallel.h"
#include "scene/mesh_edges.h"

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

}  // namespace prelight
