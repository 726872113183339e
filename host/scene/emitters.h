#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "prelight/compiled_scene.h"

namespace prelight {

/// An emissive triangle, or a part of one with about uniform radiance, from which light selection chooses.
struct Emitter {
  std::uint32_t triangle = 0;
  glm::vec2 origin{0.0f};    ///< as in EmissionParts::Part
  float scale = 1.0f;        ///< as in EmissionParts::Part
  glm::vec3 radiance{0.0f};  ///< mean over the emitter, W/(m2 sr)
  double area = 0.0;         ///< m2
  std::uint32_t part = 0;    ///< index in the scene's EmissionParts, if it has any
};

/// Returns all emitters by ascending triangle, the parts of a triangle one after the other.
std::vector<Emitter> emittersOf(const CompiledScene& scene);

/// Returns the emitters of one triangle.
std::vector<Emitter> emittersOf(const CompiledScene& scene, std::uint32_t triangle);

/// Returns true when some part of a triangle emits light.
bool emits(const CompiledScene& scene, std::uint32_t triangle);

/// Returns the mean radiance of a triangle, W/(m2 sr).
glm::vec3 meanEmission(const CompiledScene& scene, std::uint32_t triangle);

/// Returns the weights of a triangle's vertices 1 and 2 for those of an emitter's own corners.
inline glm::dvec2 placeOn(const Emitter& emitter, const glm::dvec2& weights) {
  return glm::dvec2(emitter.origin) + double(emitter.scale) * weights;
}

/// Calls use(part) for all parts below a reference of EmissionParts.
template <typename Use>
void forEachPart(const EmissionParts& parts, std::uint32_t at, const Use& use) {
  if (at == EmissionParts::dark) return;
  if ((at & EmissionParts::leaf) != 0) return use(at & ~EmissionParts::leaf);
  for (const std::uint32_t child : parts.nodes[at]) forEachPart(parts, child, use);
}

}  // namespace prelight
