#include "scene/opaque_solids.h"

#include <algorithm>
#include <numeric>
#include <unordered_map>

#include "scene/union_find.h"

namespace prelight {
namespace {

/// Greatest number of pairs of parts whose bounds are compared; with more, the rest are taken to meet.
constexpr std::size_t mostPairs = 4'000'000;

constexpr float sizeOfPlace = 1e-6f;  ///< size of a cell as a share of the scene's

/// Triangles that are connected by shared positions.
struct Part {
  glm::vec3 lower{3e38f}, upper{-3e38f};
  std::uint64_t openEdges = 0;  ///< sum of codes of directed edges: 0 when each edge has an opposite one
  double volume = 0.0;
  bool opaque = true;  ///< opaque and one-sided

  bool isSolid() const { return opaque && openEdges == 0 && volume > 0.0; }
};

std::uint64_t scrambled(std::uint64_t x) {
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9u;
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebu;
  return x ^ (x >> 31);
}

struct GridHash {
  std::size_t operator()(const glm::ivec3& cell) const {
    const auto part = [](int x) { return std::uint64_t{static_cast<std::uint32_t>(x)}; };
    return static_cast<std::size_t>(
        scrambled(part(cell.x) + (part(cell.y) << 32) + 0x9e3779b97f4a7c15u * part(cell.z)));
  }
};

/// Returns [vertex] a vertex that represents all at its position: those in one cell of either of two grids
/// offset by half a cell, so that rounding separates few equal positions.
std::vector<std::uint32_t> placesOf(const CompiledScene& scene) {
  const float side = std::max(sizeOfPlace * glm::length(scene.boundsMax - scene.boundsMin), 1e-30f);
  std::vector<std::uint32_t> places(scene.vertexCount());
  std::iota(places.begin(), places.end(), 0u);
  for (const float shift : {0.0f, 0.5f}) {
    std::unordered_map<glm::ivec3, std::uint32_t, GridHash> first(scene.vertexCount());
    for (std::uint32_t v = 0; v < scene.vertexCount(); ++v) {
      const glm::vec3 place = (scene.positions[v] - scene.boundsMin) / side;
      const auto cell = first.emplace(glm::ivec3(glm::floor(place + shift)), v).first;
      places[rootOf(places, v)] = rootOf(places, cell->second);
    }
  }
  for (std::uint32_t v = 0; v < scene.vertexCount(); ++v) places[v] = rootOf(places, v);
  return places;
}

/// Returns a code such that opposite edges cancel in a sum; collisions of others are negligibly rare.
std::uint64_t codeOf(std::uint32_t from, std::uint32_t to) {
  if (from == to) return 0;
  const std::uint64_t code = scrambled((std::uint64_t{std::min(from, to)} << 32 | std::max(from, to)) + 1);
  return from < to ? code : 0 - code;
}

bool hidesInside(const CompiledMaterial& material) {
  return !material.doubleSided && !material.blended && material.alphaCutoff < 0.0f &&
         material.transmission == 0.0f && material.translucency == 0.0f;
}

struct Parts {
  std::vector<Part> parts;
  std::vector<std::uint32_t> partOf;  ///< [triangle]
};

Parts partsOf(const CompiledScene& scene) {
  const std::vector<std::uint32_t> places = placesOf(scene);
  std::vector<std::uint32_t> parents(places.size());
  std::iota(parents.begin(), parents.end(), 0u);
  for (const glm::uvec3& t : scene.triangles)
    for (const std::uint32_t v : {t.y, t.z})
      parents[rootOf(parents, places[t.x])] = rootOf(parents, places[v]);
  Parts found;
  std::vector<std::uint32_t> numbers(places.size(), ~0u);
  for (std::uint32_t t = 0; t < scene.triangleCount(); ++t) {
    const glm::uvec3& corners = scene.triangles[t];
    std::uint32_t& number = numbers[rootOf(parents, places[corners.x])];
    if (number == ~0u) {
      number = static_cast<std::uint32_t>(found.parts.size());
      found.parts.emplace_back();
    }
    found.partOf.push_back(number);
    Part& part = found.parts[number];
    for (int k = 0; k < 3; ++k) {
      const glm::vec3& p = scene.positions[corners[k]];
      part.lower = glm::min(part.lower, p);
      part.upper = glm::max(part.upper, p);
      part.openEdges += codeOf(places[corners[k]], places[corners[(k + 1) % 3]]);
    }
    part.opaque = part.opaque && hidesInside(scene.materials[scene.triangleMaterials[t]]);
    part.volume += glm::dot(glm::dvec3(scene.positions[corners.x]), geometricNormal(scene, t));
  }
  return found;
}

bool overlap(const Part& a, const Part& b) {
  return glm::all(glm::lessThan(a.lower, b.upper)) && glm::all(glm::lessThan(b.lower, a.upper));
}

/// Returns [part] whether it is a solid and the bounds of another part reach into its bounds.
std::vector<std::uint8_t> enteredSolids(const std::vector<Part>& parts) {
  std::vector<std::uint32_t> order(parts.size());
  std::iota(order.begin(), order.end(), 0u);
  std::sort(order.begin(), order.end(),
            [&](std::uint32_t a, std::uint32_t b) { return parts[a].lower.x < parts[b].lower.x; });
  std::vector<std::uint8_t> entered(parts.size(), 0);
  std::size_t pairs = 0;
  for (std::size_t i = 0; i < order.size(); ++i)
    for (std::size_t j = i + 1; j < order.size(); ++j) {
      const Part &a = parts[order[i]], &b = parts[order[j]];
      if (!(b.lower.x < a.upper.x)) break;
      if (++pairs < mostPairs && !overlap(a, b)) continue;
      if (a.isSolid()) entered[order[i]] = 1;
      if (b.isSolid()) entered[order[j]] = 1;
      if (pairs >= mostPairs) break;
    }
  return entered;
}

}  // namespace

std::vector<std::uint8_t> trianglesOfEnteredSolids(const CompiledScene& scene) {
  const Parts found = partsOf(scene);
  const std::vector<std::uint8_t> entered = enteredSolids(found.parts);
  if (std::none_of(entered.begin(), entered.end(), [](std::uint8_t mark) { return mark != 0; })) return {};
  std::vector<std::uint8_t> triangles(scene.triangleCount());
  for (std::uint32_t t = 0; t < scene.triangleCount(); ++t) triangles[t] = entered[found.partOf[t]];
  return triangles;
}

}  // namespace prelight
