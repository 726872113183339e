#include "scene/seen_from_behind.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <optional>
#include <set>
#include <span>
#include <utility>

#include "base/directions.h"
#include "scene/light_sources.h"
#include "scene/surface/surface_blocks.h"
#include "scene/surface/surface_regions.h"

namespace prelight {

namespace {

/// Distance in front of an emissive triangle at which its light is taken to start, in units of the root of
/// its area.
constexpr double beforeEmitter = 0.01;

Viewpoint beforeLargestTriangle(const CompiledScene& scene, const PrimitiveRange& range) {
  std::uint32_t largest = range.firstTriangle;
  double most = 0.0;
  for (std::uint32_t t = range.firstTriangle; t < range.firstTriangle + range.triangleCount; ++t) {
    const double size = glm::length(geometricNormal(scene, t));
    if (size > most) largest = t;
    most = std::max(most, size);
  }
  const glm::uvec3& corners = scene.triangles[largest];
  const glm::dvec3 middle = (glm::dvec3(scene.positions[corners.x]) + glm::dvec3(scene.positions[corners.y]) +
                             glm::dvec3(scene.positions[corners.z])) /
                            3.0;
  return {middle + beforeEmitter / std::sqrt(most) * geometricNormal(scene, largest), false,
          fmt::format("emissive surface \"{}\"", range.name)};
}

void takeEvenly(const std::vector<Viewpoint>& from, std::size_t most, std::vector<Viewpoint>& to) {
  const std::size_t count = std::min(from.size(), most);
  for (std::size_t i = 0; i < count; ++i) to.push_back(from[i * from.size() / count]);
}

}  // namespace

std::vector<Viewpoint> viewpointsOf(const Scene& scene, const CompiledScene& compiled, std::size_t most) {
  std::vector<Viewpoint> cameras, lamps;
  for (const Camera& camera : scene.cameras)
    cameras.push_back({glm::dvec3(camera.world[3]) - compiled.origin, true, {}});
  for (const Light& light : scene.lights)
    if (light.type == LightType::Point || light.type == LightType::Spot)
      lamps.push_back({light.position - compiled.origin, false, fmt::format("light \"{}\"", light.name)});
  for (const PrimitiveRange& range : compiled.primitives) {
    if (range.triangleCount == 0) continue;
    const CompiledMaterial& material = compiled.materials[compiled.triangleMaterials[range.firstTriangle]];
    if (shines(material.emission)) lamps.push_back(beforeLargestTriangle(compiled, range));
  }
  std::vector<Viewpoint> all;
  takeEvenly(cameras, most, all);
  takeEvenly(lamps, most, all);
  return all;
}

namespace {

constexpr double enclosing = 0.5;  ///< least share of the sphere that a room's surfaces cover
constexpr double closed = 0.97;    ///< from this share on, light from outside is negligible
constexpr int rays = 256;          ///< from a viewpoint that may be in a room
constexpr int leastBacks = rays / 4;
constexpr double leastOfPart = 0.005;  ///< least share of the sphere that a part must cover to count

/// Greatest number of evaluations of a block from a viewpoint. Each takes some 20 ns: all together stay below
/// a twentieth of a second.
constexpr std::size_t mostLooks = 2'000'000;
/// Greatest number of evaluations of single triangles, at about the same cost each, for viewpoints in large
/// rooms.
constexpr std::size_t mostTriangleLooks = 20'000'000;
constexpr std::size_t fewestViewpoints = 16, mostViewpoints = 1024;

constexpr int outsideSamples = 256;  ///< number of surface samples that may lie outside a room
constexpr double within = 0.25;      ///< least share that a room covers as seen from inside
constexpr double offSurface = 1e-2;  ///< in units of the triangle's size

/// Least sum over viewpoints for which a part that was turned to its normals counts as seen from one side.
constexpr double decisive = 0.02;

/// Greatest ratio of the length of the summed area vectors to the summed areas of a closed part, whose faces
/// point everywhere.
constexpr double closedSum = 1e-3;

/// A part of a primitive: the indices of the primitive and the part.
using PartKey = std::pair<std::uint32_t, std::uint32_t>;

/// A viewpoint that is surrounded by backs.
struct Enclosure {
  std::set<PartKey> parts;
  double share = 0.0;   ///< share of the sphere that the backs cover
  double beyond = 0.0;  ///< share of the sphere that backs of other surfaces cover behind them
  bool camera = false;
  bool lightsOthers = false;  ///< light reaches something else
  std::string lamp = {};      ///< name of the lamp
};

/// Returns true for materials that block sight and light. Bodies of glass have no fronts and backs, and holes
/// block nothing.
bool isWall(const CompiledMaterial& m) { return m.transmission <= 0.0f && m.alphaCutoff < 0.0f; }

const CompiledMaterial& materialOf(const CompiledScene& scene, const PrimitiveRange& range) {
  return scene.materials[scene.triangleMaterials[range.firstTriangle]];
}

std::vector<std::uint8_t> wallsOf(const CompiledScene& scene) {
  std::vector<std::uint8_t> walls;
  for (const PrimitiveRange& range : scene.primitives)
    walls.push_back(range.triangleCount > 0 && isWall(materialOf(scene, range)) ? 1 : 0);
  return walls;
}

/// Returns directions distributed uniformly over the sphere.
glm::dvec3 directionOf(int ray) {
  return directionAbout({0.0, 1.0, 0.0}, 1.0 - (2.0 * ray + 1.0) / rays, ray);
}

glm::dvec3 middleOf(const CompiledScene& scene, std::uint32_t triangle) {
  const glm::uvec3& t = scene.triangles[triangle];
  return (glm::dvec3(scene.positions[t.x]) + glm::dvec3(scene.positions[t.y]) +
          glm::dvec3(scene.positions[t.z])) /
         3.0;
}

class BehindFinder {
 public:
  BehindFinder(const Scene& scene, const CompiledScene& compiled)
      : compiled_(compiled), walls_(wallsOf(compiled)), blocks_(compiled, walls_) {
    const std::size_t affordable = mostLooks / std::max<std::size_t>(1, blocks_.blockCount());
    viewpoints_ = viewpointsOf(scene, compiled, std::clamp(affordable, fewestViewpoints, mostViewpoints));
    sunShines_ = std::any_of(scene.lights.begin(), scene.lights.end(),
                             [](const Light& light) { return light.type == LightType::Directional; });
  }

  SeenFromBehind find() {
    for (const Viewpoint& from : viewpoints_)
      if (triangleLooks_ < mostTriangleLooks) look(from);
    const std::set<PartKey> rooms = roomParts();
    SeenFromBehind found{{}, shutInBy(rooms)};
    if (!rooms.empty()) found.marks = marksOf(rooms);
    return found;
  }

 private:
  std::vector<std::uint8_t> marksOf(const std::set<PartKey>& rooms) {
    const bool alone = nothingOutsideOf(rooms);
    std::vector<std::uint8_t> marks(compiled_.triangleCount(), 0);
    for (const PartKey& part : rooms) {
      const bool oneSided = !materialOf(compiled_, compiled_.primitives[part.first]).doubleSided;
      const std::uint8_t mark = static_cast<std::uint8_t>((oneSided ? ShowsBothSides : 0) |
                                                          (isSeenWithin(part, alone) ? FrontIsWithin : 0));
      forTrianglesOf(part, [&](std::uint32_t t) { marks[t] = mark; });
    }
    return marks;
  }

  std::vector<std::string> shutInBy(const std::set<PartKey>& rooms) const {
    std::vector<std::string> sentences;
    for (const Enclosure& e : enclosures_) {
      if (e.camera || e.parts.empty() || rooms.contains(*e.parts.begin())) continue;
      const PrimitiveRange& range = compiled_.primitives[e.parts.begin()->first];
      sentences.push_back(
          fmt::format("{} is shut in by node \"{}\", which lets none of its light out", e.lamp, range.name));
    }
    return sentences;
  }

  const SurfaceParts& partsOf(std::uint32_t primitive) {
    const auto [found, fresh] = parts_.try_emplace(primitive);
    if (fresh) found->second = surfaceParts(compiled_, compiled_.primitives[primitive]);
    return found->second;
  }

  template <typename Visit>
  void forTrianglesOf(const PartKey& part, const Visit& visit) {
    const std::uint32_t first = compiled_.primitives[part.first].firstTriangle;
    for (const std::uint32_t t : partsOf(part.first).trianglesOf(part.second)) visit(first + t);
  }

  PartKey partOf(std::uint32_t triangle) {
    const auto range = std::upper_bound(
        compiled_.primitives.begin(), compiled_.primitives.end(), triangle,
        [](std::uint32_t t, const PrimitiveRange& r) { return t < r.firstTriangle + r.triangleCount; });
    const auto primitive = static_cast<std::uint32_t>(range - compiled_.primitives.begin());
    return {primitive, partsOf(primitive).partOf[triangle - range->firstTriangle]};
  }

  double shareOf(const PartKey& part, const glm::dvec3& point) {
    double share = 0.0;
    triangleLooks_ += partsOf(part.first).trianglesOf(part.second).size();
    forTrianglesOf(part, [&](std::uint32_t t) { share += backShare(compiled_, t, point); });
    return share;
  }

  double backsAround(const glm::dvec3& point) const {
    double backs = 0.0;
    for (const double share : blocks_.backShares(point)) backs += std::max(share, 0.0);
    return backs;
  }

  void look(const Viewpoint& from) {
    std::optional<Enclosure> found;
    const double backs = backsAround(from.place);
    if (backs > enclosing) found = enclosureOf(from);
    if (found) {
      found->beyond = backs - found->share;
      enclosures_.push_back(*std::move(found));
    } else {
      ++(from.camera ? openCameras_ : openLamps_);
    }
  }

  std::optional<Enclosure> enclosureOf(const Viewpoint& from) {
    std::map<PartKey, int> backs, others;
    for (int ray = 0; ray < rays; ++ray)
      if (const auto met = blocks_.firstMet(from.place, directionOf(ray)))
        ++(met->back ? backs : others)[partOf(met->triangle)];
    Enclosure found;
    found.camera = from.camera;
    found.lamp = from.name;
    int seen = 0;
    for (const auto& [part, count] : backs) {
      const double share = shareOf(part, from.place);
      if (share < leastOfPart) continue;
      found.parts.insert(part);
      found.share += share;
      seen += count;
    }
    if (seen < leastBacks || found.share <= enclosing) return std::nullopt;
    found.lightsOthers = std::any_of(others.begin(), others.end(), [&](const auto& other) {
      return !found.parts.contains(other.first) && !isLamp(other.first.first);
    });
    return found;
  }

  bool isLamp(std::uint32_t primitive) const {
    return shines(materialOf(compiled_, compiled_.primitives[primitive]).emission);
  }

  static bool shareParts(const Enclosure& a, const Enclosure& b) {
    return std::any_of(a.parts.begin(), a.parts.end(),
                       [&](const PartKey& part) { return b.parts.contains(part); });
  }

  bool hasLampWithin(const Enclosure& room) const {
    return std::any_of(enclosures_.begin(), enclosures_.end(),
                       [&](const Enclosure& other) { return !other.camera && shareParts(room, other); });
  }

  bool isRoom(const Enclosure& e) const {
    return e.camera ? e.share < closed || hasLampWithin(e) : e.lightsOthers;
  }

  /// Returns the parts that form rooms. Parts that are neither rooms by themselves nor within one may,
  /// together with rooms, be the entire scene.
  std::set<PartKey> roomParts() {
    std::set<PartKey> rooms, all;
    for (const Enclosure& e : enclosures_) {
      if (isRoom(e)) rooms.insert(e.parts.begin(), e.parts.end());
      if (isRoom(e) || e.beyond < within) all.insert(e.parts.begin(), e.parts.end());
    }
    return rooms != all && nothingOutsideOf(all) ? all : rooms;
  }

  /// Returns true when nothing but lamps' own surfaces lies outside the rooms.
  bool nothingOutsideOf(const std::set<PartKey>& rooms) {
    std::set<std::uint32_t> primitives;
    for (const PartKey& part : rooms) primitives.insert(part.first);
    const std::uint32_t step = std::max(1u, compiled_.triangleCount() / outsideSamples);
    for (std::uint32_t t = 0; t < compiled_.triangleCount(); t += step) {
      const PartKey part = partOf(t);
      if (walls_[part.first] == 0 || isLamp(part.first) || rooms.contains(part)) continue;
      if (coverBoth(primitives, t) < within) return false;
    }
    return true;
  }

  /// Returns the greater of the shares that primitives cover in front of a triangle and behind it; the
  /// triangle may lie on one of them.
  double coverBoth(const std::set<std::uint32_t>& primitives, std::uint32_t triangle) const {
    const glm::dvec3 normal = geometricNormal(compiled_, triangle);
    const double area = glm::length(normal);
    if (area <= 0.0) return 1.0;
    const glm::dvec3 step = normal * (offSurface / std::sqrt(area));
    double most = 0.0;
    for (const double side : {-1.0, 1.0}) {
      const std::vector<double> shares = blocks_.backShares(middleOf(compiled_, triangle) + side * step);
      double covered = 0.0;
      for (const std::uint32_t primitive : primitives) covered += shares[primitive];
      most = std::max(most, covered);
    }
    return most;
  }

  /// Returns true when more cameras see a part from within than stand in the open; without cameras, lamps
  /// decide.
  bool isSeenWithin(const PartKey& part, bool alone) const {
    int cameras = 0;
    for (const Enclosure& e : enclosures_)
      if (e.camera && e.parts.contains(part)) ++cameras;
    if (cameras > 0 || openCameras_ > 0) return cameras > 0 && cameras >= openCameras_;
    return alone && openLamps_ == 0 && !sunShines_;
  }

  const CompiledScene& compiled_;
  std::vector<std::uint8_t> walls_;  ///< [primitive]
  SurfaceBlocks blocks_;
  std::vector<Viewpoint> viewpoints_;
  bool sunShines_ = false;
  std::map<std::uint32_t, SurfaceParts> parts_;  ///< by primitive
  std::vector<Enclosure> enclosures_;
  int openCameras_ = 0, openLamps_ = 0;
  std::size_t triangleLooks_ = 0;
};

/// Returns true when triangles enclose a volume into which their faces look.
bool looksInwards(const CompiledScene& scene, std::uint32_t first, std::span<const std::uint32_t> triangles) {
  const glm::dvec3 centre = middleOf(scene, first + triangles.front());
  glm::dvec3 sum(0.0);
  double area = 0.0, volume = 0.0;
  for (const std::uint32_t t : triangles) {
    const glm::dvec3 face = geometricNormal(scene, first + t);
    sum += face;
    area += glm::length(face);
    volume += glm::dot(middleOf(scene, first + t) - centre, face);
  }
  return glm::length(sum) <= closedSum * area && volume < 0.0;
}

bool isWronglyTurned(const CompiledScene& scene, const std::vector<Viewpoint>& viewpoints,
                     std::uint32_t first, std::span<const std::uint32_t> triangles) {
  double backs = 0.0;
  for (const Viewpoint& from : viewpoints)
    for (const std::uint32_t t : triangles) backs += backShare(scene, first + t, from.place);
  return std::abs(backs) > decisive ? backs > 0.0 : looksInwards(scene, first, triangles);
}

}  // namespace

std::vector<std::uint8_t> wronglyTurned(const Scene& scene, const CompiledScene& compiled) {
  if (compiled.triangleTurns.empty()) return {};
  const std::vector<Viewpoint> viewpoints = viewpointsOf(scene, compiled, fewestViewpoints);
  const auto wasTurned = [&](std::uint32_t t) { return (compiled.triangleTurns[t] & CornersExchanged) != 0; };
  std::vector<std::uint8_t> marks(compiled.triangleCount(), 0);
  bool any = false;
  for (const PrimitiveRange& range : compiled.primitives) {
    const auto begin = compiled.triangleTurns.begin() + range.firstTriangle;
    if (std::all_of(begin, begin + range.triangleCount, [](std::uint8_t turn) { return turn == 0; }))
      continue;
    const SurfaceParts parts = surfaceParts(compiled, range);
    for (std::uint32_t part = 0; part < parts.count(); ++part) {
      const std::span<const std::uint32_t> triangles = parts.trianglesOf(part);
      const bool all = std::all_of(triangles.begin(), triangles.end(),
                                   [&](std::uint32_t t) { return wasTurned(range.firstTriangle + t); });
      if (!all || !isWronglyTurned(compiled, viewpoints, range.firstTriangle, triangles)) continue;
      for (const std::uint32_t t : triangles) marks[range.firstTriangle + t] = 1;
      any = true;
    }
  }
  return any ? marks : std::vector<std::uint8_t>{};
}

SeenFromBehind seenFromBehind(const Scene& scene, const CompiledScene& compiled) {
  const bool lamps = std::any_of(scene.lights.begin(), scene.lights.end(), [](const Light& light) {
    return light.type == LightType::Point || light.type == LightType::Spot;
  });
  if (compiled.triangleCount() == 0 || (!lamps && scene.cameras.empty() && !hasEmitters(compiled))) return {};
  return BehindFinder(scene, compiled).find();
}

}  // namespace prelight
