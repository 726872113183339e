#include "scene/surface_regions.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

#include "scene/mesh_edges.h"

namespace prelight {

namespace {

constexpr double angleSlack = 1e-4;   // rad, around the crease angle
constexpr double leastNoise = 0.05;   // rad; the normals of slivers are more uncertain
constexpr double rounding = 0x1p-22;  // relative error of coordinates after a transform
// Number of rounds in which slivers next to slivers are attached one by one.
constexpr int sliverRounds = 16;
constexpr std::uint32_t none = 0xffffffffu;

class RegionGrower {
 public:
  RegionGrower(const CompiledScene& scene, double creaseAngle)
      : scene_(scene), creaseAngle_(creaseAngle), parent_(scene.triangleCount()) {
    std::iota(parent_.begin(), parent_.end(), 0u);
    for (std::uint32_t t = 0; t < scene.triangleCount(); ++t) addTriangle(t);
  }

  SurfaceRegions grow() {
    forEachContinuation(scene_, [&](const EdgeSide& a, const EdgeSide& b) { meet(a, b); });
    attachSlivers();
    return number();
  }

 private:
  /// Two adjacent triangles, one of them a sliver.
  struct Contact {
    double angle = 0.0;
    std::uint32_t first = 0;
    std::uint32_t second = 0;
  };

  void addTriangle(std::uint32_t t) {
    const glm::dvec3 normal = geometricNormal(scene_, t);
    const double length = glm::length(normal);
    areas_.push_back(0.5 * length);
    normals_.push_back(length > 0.0 ? normal / length : glm::dvec3(0.0));
    double longest = 0.0, largest = 0.0;
    for (int corner = 0; corner < 3; ++corner) {
      const glm::dvec3 p(scene_.positions[scene_.triangles[t][corner]]),
          q(scene_.positions[scene_.triangles[t][(corner + 1) % 3]]);
      longest = std::max(longest, glm::distance(p, q));
      largest = std::max({largest, std::abs(p.x), std::abs(p.y), std::abs(p.z)});
    }
    const double height = length / longest;
    sliver_.push_back(!(rounding * largest < leastNoise * height));
  }

  std::uint32_t root(std::uint32_t t) {
    while (parent_[t] != t) t = parent_[t] = parent_[parent_[t]];
    return t;
  }

  void unite(std::uint32_t a, std::uint32_t b) {
    a = root(a), b = root(b);
    parent_[std::max(a, b)] = std::min(a, b);
  }

  void meet(const EdgeSide& a, const EdgeSide& b) {
    const glm::dvec3 &n = normals_[a.triangle], &m = normals_[b.triangle];
    const double angle = std::atan2(glm::length(glm::cross(n, m)), glm::dot(n, m));
    if (sliver_[a.triangle] || sliver_[b.triangle])
      contacts_.push_back({angle, a.triangle, b.triangle});
    else if (angle < creaseAngle_ - angleSlack)
      unite(a.triangle, b.triangle);
  }

  /// Attaches slivers by ascending angle; those that are left touch only slivers, and are joined to them.
  void attachSlivers() {
    std::stable_sort(contacts_.begin(), contacts_.end(),
                     [](const Contact& a, const Contact& b) { return a.angle < b.angle; });
    std::vector<std::uint8_t> loose = sliver_;
    bool changed = true;
    for (int round = 0; changed && round < sliverRounds; ++round) {
      changed = false;
      for (const Contact& contact : contacts_) {
        if (loose[contact.first] == loose[contact.second]) continue;
        unite(contact.first, contact.second);
        loose[contact.first] = loose[contact.second] = 0;
        changed = true;
      }
    }
    for (const Contact& contact : contacts_)
      if (loose[contact.first] && loose[contact.second]) unite(contact.first, contact.second);
  }

  SurfaceRegions number() {
    SurfaceRegions regions;
    std::vector<std::uint32_t> regionOfRoot(parent_.size(), none);
    for (std::uint32_t t = 0; t < parent_.size(); ++t) {
      std::uint32_t& region = regionOfRoot[root(t)];
      if (region == none) {
        region = regions.count();
        regions.areas.push_back(0.0);
      }
      regions.regionOf.push_back(region);
      regions.areas[region] += areas_[t];
    }
    return regions;
  }

  const CompiledScene& scene_;
  double creaseAngle_;
  std::vector<std::uint32_t> parent_;  ///< [triangle]
  std::vector<double> areas_;          ///< [triangle], m2
  std::vector<glm::dvec3> normals_;    ///< [triangle], unit
  std::vector<std::uint8_t> sliver_;   ///< [triangle]
  std::vector<Contact> contacts_;
};

}  // namespace

SurfaceRegions makeSurfaceRegions(const CompiledScene& scene, double creaseAngle) {
  return RegionGrower(scene, creaseAngle).grow();
}

SurfaceRegions splitByPrimitive(const SurfaceRegions& regions, const CompiledScene& scene) {
  SurfaceRegions split;
  split.regionOf.resize(scene.triangleCount());
  for (const PrimitiveRange& range : scene.primitives) {
    std::map<std::uint32_t, std::uint32_t>
        numbers;  // region of this primitive, by the region from which it is cut
    for (std::uint32_t t = range.firstTriangle; t < range.firstTriangle + range.triangleCount; ++t) {
      const auto [entry, fresh] = numbers.try_emplace(regions.regionOf[t], split.count());
      if (fresh) split.areas.push_back(0.0);
      split.regionOf[t] = entry->second;
      split.areas[entry->second] += 0.5 * glm::length(geometricNormal(scene, t));
    }
  }
  return split;
}

}  // namespace prelight
