#include "scene/inside_out.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

#include "scene/light_sources.h"

namespace prelight {
namespace {

/// Largest sum of a closed surface's face vectors over the sum of their lengths: rounding.
constexpr double mostOpen = 1e-3;
/// Least volume over area to the power 3/2 (0.094 of a ball): flatter bodies are no clear case.
constexpr double leastVolume = 0.004;

struct InnerSpace {
  glm::dvec3 lower{1e300}, upper{-1e300};

  bool contain(const glm::dvec3& p) const {
    return glm::all(glm::greaterThan(p, lower)) && glm::all(glm::lessThan(p, upper));
  }
};

InnerSpace innerSpaceOf(const CompiledScene& scene, const PrimitiveRange& range) {
  InnerSpace bounds;
  for (std::uint32_t v = 0; v < range.vertexCount; ++v) {
    const glm::dvec3 p(scene.positions[range.firstVertex + v]);
    bounds.lower = glm::min(bounds.lower, p);
    bounds.upper = glm::max(bounds.upper, p);
  }
  return bounds;
}

bool looksInwards(const CompiledScene& scene, const PrimitiveRange& range, const glm::dvec3& centre) {
  glm::dvec3 open(0.0);
  double area = 0.0, volume = 0.0;
  for (std::uint32_t t = 0; t < range.triangleCount; ++t) {
    const glm::dvec3 face = 0.5 * geometricNormal(scene, range.firstTriangle + t);
    const glm::dvec3 corner(scene.positions[scene.triangles[range.firstTriangle + t].x]);
    open += face;
    area += glm::length(face);
    volume += glm::dot(corner - centre, face) / 3.0;
  }
  return glm::length(open) < mostOpen * area && -volume > leastVolume * std::pow(area, 1.5);
}

const Primitive& primitiveOf(const Scene& scene, const PrimitiveRange& range) {
  return scene.meshes[static_cast<std::size_t>(range.mesh)]
      .primitives[static_cast<std::size_t>(range.primitive)];
}

bool isPlain(const CompiledScene& scene, const PrimitiveRange& range) {
  for (std::uint32_t t = 0; t < range.triangleCount; ++t) {
    const CompiledMaterial& material = scene.materials[scene.triangleMaterials[range.firstTriangle + t]];
    if (material.doubleSided || shines(material.emission)) return false;
  }
  return range.triangleCount > 0;
}

}  // namespace

std::vector<std::uint32_t> insideOutPrimitives(const Scene& scene, const CompiledScene& compiled) {
  if (!scene.lights.empty() || !scene.cameras.empty()) return {};
  std::vector<InnerSpace> bounds;
  std::vector<glm::dvec3> things;
  for (const PrimitiveRange& range : compiled.primitives) {
    bounds.push_back(innerSpaceOf(compiled, range));
    things.push_back(0.5 * (bounds.back().lower + bounds.back().upper));
  }
  std::vector<std::uint32_t> found;
  for (std::uint32_t i = 0; i < compiled.primitives.size(); ++i) {
    const PrimitiveRange& range = compiled.primitives[i];
    if (range.mesh < 0 || scene.meshes.empty() || !isPlain(compiled, range) ||
        !looksInwards(compiled, range, things[i]))
      continue;
    // Targets of morphs shift normals, which would have to be turned as well.
    if (!primitiveOf(scene, range).targets.empty()) continue;
    bool empty = true;
    for (std::size_t k = 0; k < things.size(); ++k)
      empty = empty && (k == i || !bounds[i].contain(things[k]));
    if (empty) found.push_back(i);
  }
  return found;
}

void turnFaces(const std::vector<std::uint32_t>& primitives, Scene& scene, CompiledScene& compiled) {
  std::set<std::pair<int, int>> turned;
  for (const std::uint32_t i : primitives) {
    const PrimitiveRange& range = compiled.primitives[i];
    if (!turned.emplace(range.mesh, range.primitive).second) continue;
    Primitive& primitive = scene.meshes[static_cast<std::size_t>(range.mesh)]
                               .primitives[static_cast<std::size_t>(range.primitive)];
    for (glm::uvec3& triangle : primitive.triangles) std::swap(triangle.y, triangle.z);
    for (glm::vec3& normal : primitive.normals) normal = -normal;
  }
  Warnings said;  // by the first time
  compiled = compileScene(scene, said);
}

}  // namespace prelight
