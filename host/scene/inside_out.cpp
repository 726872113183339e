#include "scene/inside_out.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <utility>

#include "scene/closed_bodies.h"
#include "scene/light_sources.h"

namespace prelight {
namespace {

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
  if (!scene.lights.empty() || !scene.cameras.empty() || scene.meshes.empty()) return {};
  std::vector<ClosedPart> wholes;
  std::vector<std::uint32_t> likely;
  std::map<std::pair<int, int>, std::size_t> drawn, inward;
  for (std::uint32_t i = 0; i < compiled.primitives.size(); ++i) {
    const PrimitiveRange& range = compiled.primitives[i];
    wholes.push_back(asClosed(compiled, range));
    ++drawn[{range.mesh, range.primitive}];
    // Morph targets change normals, and would have to be reversed as well.
    if (range.mesh >= 0 && wholes.back().volume < 0.0 && isPlain(compiled, range) &&
        primitiveOf(scene, range).targets.empty())
      likely.push_back(i);
  }
  if (likely.size() > mostClosedBodies) return {};
  const BodyCentres centres(wholes);
  std::vector<std::uint32_t> found;
  for (const std::uint32_t i : likely) {
    const PrimitiveRange& range = compiled.primitives[i];
    if (centres.anyWithin(wholes[i], i) || sideOfBodies(compiled, range) != BodySide::Inside) continue;
    ++inward[{range.mesh, range.primitive}];
    found.push_back(i);
  }
  // A mesh that is drawn as a room anywhere is meant to be seen from inside.
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
    // The bitangent is w n x t, and must stay unchanged.
    for (glm::vec4& tangent : primitive.tangents) tangent.w = -tangent.w;
  }
  Warnings said;  // these warnings were given the first time
  compiled = compileScene(scene, said);
}

std::string insideOutText(const std::filesystem::path& file, const CompiledScene& scene,
                          const std::vector<std::uint32_t>& primitives) {
  const PrimitiveRange& first = scene.primitives[primitives.front()];
  const std::string more =
      primitives.size() > 1 ? fmt::format(" and {} more", primitives.size() - 1) : std::string();
  return fmt::format("{}: node {} \"{}\"{}: a closed surface whose faces all look inwards is inside out",
                     file.string(), first.node, first.name, more);
}

}  // namespace prelight
