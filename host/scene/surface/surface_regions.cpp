#include "scene/surface/surface_regions.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <map>
#include <numeric>
#include <unordered_map>

#include "scene/surface/mesh_edges.h"

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

namespace {

struct PlaceHash {
  std::size_t operator()(const glm::vec3& place) const {
    std::uint64_t hash = 0x9e3779b97f4a7c15u;
    for (int axis = 0; axis < 3; ++axis) {
      hash = (hash ^ std::bit_cast<std::uint32_t>(place[axis] + 0.0f)) * 0xbf58476d1ce4e5b9u;
      hash ^= hash >> 29;
    }
    return static_cast<std::size_t>(hash);
  }
};

struct EdgeOfPart {
  std::uint32_t low = 0, high = 0;  ///< positions of its ends, as placesOf() numbers them
  std::uint32_t triangle = 0;
  bool falling = false;  ///< runs from high to low

  bool sameEdge(const EdgeOfPart& other) const { return low == other.low && high == other.high; }
};

/// Returns [vertex of the primitive] the first vertex at its position.
std::vector<std::uint32_t> placesOf(const CompiledScene& scene, const PrimitiveRange& range) {
  std::unordered_map<glm::vec3, std::uint32_t, PlaceHash> first(range.vertexCount);
  std::vector<std::uint32_t> places;
  for (std::uint32_t v = 0; v < range.vertexCount; ++v)
    places.push_back(first.try_emplace(scene.positions[range.firstVertex + v], v).first->second);
  return places;
}

glm::uvec3 cornersOf(const CompiledScene& scene, const PrimitiveRange& range, std::uint32_t triangle) {
  return scene.triangles[range.firstTriangle + triangle] - glm::uvec3(range.firstVertex);
}

std::vector<EdgeOfPart> edgesOfParts(const CompiledScene& scene, const PrimitiveRange& range) {
  const std::vector<std::uint32_t> places = placesOf(scene, range);
  std::vector<EdgeOfPart> edges;
  for (std::uint32_t t = 0; t < range.triangleCount; ++t) {
    const glm::uvec3 corners = cornersOf(scene, range, t);
    for (int k = 0; k < 3; ++k) {
      const std::uint32_t from = places[corners[k]], to = places[corners[(k + 1) % 3]];
      if (from != to) edges.push_back({std::min(from, to), std::max(from, to), t, from > to});
    }
  }
  std::sort(edges.begin(), edges.end(), [](const EdgeOfPart& a, const EdgeOfPart& b) {
    return a.low != b.low ? a.low < b.low : a.high != b.high ? a.high < b.high : a.triangle < b.triangle;
  });
  return edges;
}

void joinByVertices(const CompiledScene& scene, const PrimitiveRange& range,
                    std::vector<std::uint32_t>& parents) {
  std::vector<std::uint32_t> first(range.vertexCount, none);
  for (std::uint32_t t = 0; t < range.triangleCount; ++t) {
    const glm::uvec3 corners = cornersOf(scene, range, t);
    for (int k = 0; k < 3; ++k) {
      std::uint32_t& user = first[corners[k]];
      if (user == none) user = t;
      parents[rootOf(parents, t)] = rootOf(parents, user);
    }
  }
}

void joinByEdges(const std::vector<EdgeOfPart>& edges, std::vector<std::uint32_t>& parents) {
  for (std::size_t first = 0, end = 0; first < edges.size(); first = end) {
    for (end = first + 1; end < edges.size() && edges[end].sameEdge(edges[first]);) ++end;
    if (end == first + 2 && edges[first].falling != edges[first + 1].falling)
      parents[rootOf(parents, edges[first].triangle)] = rootOf(parents, edges[first + 1].triangle);
  }
}

}  // namespace

SurfaceParts surfaceParts(const CompiledScene& scene, const PrimitiveRange& range) {
  std::vector<std::uint32_t> parents(range.triangleCount);
  std::iota(parents.begin(), parents.end(), 0u);
  joinByVertices(scene, range, parents);
  joinByEdges(edgesOfParts(scene, range), parents);
  SurfaceParts parts;
  std::vector<std::uint32_t> numbers(range.triangleCount, ~0u), sizes;
  for (std::uint32_t t = 0; t < range.triangleCount; ++t) {
    std::uint32_t& number = numbers[rootOf(parents, t)];
    if (number == ~0u) {
      number = static_cast<std::uint32_t>(sizes.size());
      sizes.push_back(0);
    }
    ++sizes[number];
    parts.partOf.push_back(number);
  }
  parts.first.push_back(0);
  for (const std::uint32_t size : sizes) parts.first.push_back(parts.first.back() + size);
  std::vector<std::uint32_t> next(parts.first.begin(), parts.first.end() - 1);
  parts.triangles.resize(range.triangleCount);
  for (std::uint32_t t = 0; t < range.triangleCount; ++t) parts.triangles[next[parts.partOf[t]]++] = t;
  return parts;
}

}  // namespace prelight
