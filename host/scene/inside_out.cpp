#include "scene/inside_out.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <utility>

#include "scene/closed_parts.h"
#include "scene/light_sources.h"

namespace prelight {
namespace {

/// Least volume over area to the power 3/2 (0.094 of a ball): flatter bodies are no clear case.
constexpr double leastVolume = 0.004;
/// More bodies than anybody models by mistake: they are left as they are, for the time that they would take.
constexpr std::size_t mostBodies = 1000;

bool contain(const ClosedPart& bounds, const glm::dvec3& p) {
  return glm::all(glm::greaterThan(p, bounds.lower)) && glm::all(glm::lessThan(p, bounds.upper));
}

glm::dvec3 centreOf(const ClosedPart& part) { return 0.5 * (part.lower + part.upper); }

/// Bounds, area and volume of a primitive as if it were closed.
ClosedPart wholeOf(const CompiledScene& scene, const PrimitiveRange& range) {
  ClosedPart whole;
  for (std::uint32_t v = 0; v < range.vertexCount; ++v) {
    const glm::dvec3 p(scene.positions[range.firstVertex + v]);
    whole.lower = glm::min(whole.lower, p);
    whole.upper = glm::max(whole.upper, p);
  }
  for (std::uint32_t t = 0; t < range.triangleCount; ++t) {
    const glm::dvec3 face = 0.5 * geometricNormal(scene, range.firstTriangle + t);
    const glm::dvec3 corner(scene.positions[scene.triangles[range.firstTriangle + t].x]);
    whole.area += glm::length(face);
    whole.volume += glm::dot(corner - centreOf(whole), face) / 3.0;
  }
  return whole;
}

/// Whether a primitive is closed bodies beside each other, of which every one looks inwards.
bool looksInwards(const CompiledScene& scene, const PrimitiveRange& range) {
  const auto parts = closedParts(scene, range);
  if (!parts || parts->size() > mostBodies) return false;
  for (const ClosedPart& part : *parts) {
    if (!(-part.volume > leastVolume * std::pow(part.area, 1.5))) return false;
    for (const ClosedPart& other : *parts)
      if (&other != &part && contain(part, centreOf(other))) return false;
  }
  return true;
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

/// Centres of primitives, by their first coordinate.
class Things {
 public:
  explicit Things(const std::vector<ClosedPart>& wholes) {
    for (std::uint32_t i = 0; i < wholes.size(); ++i) centres_.emplace_back(centreOf(wholes[i]), i);
    std::sort(centres_.begin(), centres_.end(),
              [](const auto& a, const auto& b) { return a.first.x < b.first.x; });
  }

  bool anyWithin(const ClosedPart& bounds, std::uint32_t butNot) const {
    auto thing = std::upper_bound(centres_.begin(), centres_.end(), bounds.lower.x,
                                  [](double x, const auto& other) { return x < other.first.x; });
    for (; thing != centres_.end() && thing->first.x < bounds.upper.x; ++thing)
      if (thing->second != butNot && contain(bounds, thing->first)) return true;
    return false;
  }

 private:
  std::vector<std::pair<glm::dvec3, std::uint32_t>> centres_;
};

}  // namespace

std::vector<std::uint32_t> insideOutPrimitives(const Scene& scene, const CompiledScene& compiled) {
  if (!scene.lights.empty() || !scene.cameras.empty() || scene.meshes.empty()) return {};
  std::vector<ClosedPart> wholes;
  std::vector<std::uint32_t> likely;
  std::map<std::pair<int, int>, std::size_t> drawn, inward;
  for (std::uint32_t i = 0; i < compiled.primitives.size(); ++i) {
    const PrimitiveRange& range = compiled.primitives[i];
    wholes.push_back(wholeOf(compiled, range));
    ++drawn[{range.mesh, range.primitive}];
    // Targets of morphs shift normals, which would have to be turned as well.
    if (range.mesh >= 0 && wholes.back().volume < 0.0 && isPlain(compiled, range) &&
        primitiveOf(scene, range).targets.empty())
      likely.push_back(i);
  }
  if (likely.size() > mostBodies) return {};
  const Things things(wholes);
  std::vector<std::uint32_t> found;
  for (const std::uint32_t i : likely) {
    const PrimitiveRange& range = compiled.primitives[i];
    if (things.anyWithin(wholes[i], i) || !looksInwards(compiled, range)) continue;
    ++inward[{range.mesh, range.primitive}];
    found.push_back(i);
  }
  // Whoever drew a mesh as a room somewhere meant its inside.
  std::erase_if(found, [&](std::uint32_t i) {
    const std::pair<int, int> drawing(compiled.primitives[i].mesh, compiled.primitives[i].primitive);
    return inward[drawing] != drawn[drawing];
  });
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
    // The bitangent is w n x t: it stays where it was.
    for (glm::vec4& tangent : primitive.tangents) tangent.w = -tangent.w;
  }
  Warnings said;  // by the first time
  compiled = compileScene(scene, said);
}

}  // namespace prelight
