#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <string>
#include <vector>

#include "prelight/compiled_scene.h"
#include "prelight/picture.h"
#include "shared/shade_types.h"

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

/// Returns true when a colour or a radiance is not black.
inline bool shines(const glm::vec3& c) { return c.x > 0.0f || c.y > 0.0f || c.z > 0.0f; }

/// Returns the sky, or nullptr where it is entirely black. `sky` may be nullptr.
const Environment* shiningSky(const Environment* sky);

/// Returns true when any triangle is emissive.
bool hasEmitters(const CompiledScene& scene);

/// Describes lamps that lie within the bounds of a scene, such as "light 'Lamp'" or "emissive surfaces";
/// empty if there are none, or if the scene is flat, so that nothing lies in front of them.
std::string lampsWithin(const CompiledScene& scene);

/// Returns true when the scene has a punctual light or an emissive triangle.
bool hasLights(const CompiledScene& scene);

/// Returns true when some surface reflects or transmits light diffusely.
bool scattersDiffusely(const CompiledScene& scene);

/// Returns a light as kernels/core/punctual_funcs.cl reads it, in scene coordinates. The place of its profile
/// is not set.
device::PunctualLight deviceLight(const Light& light, const CompiledScene& scene);

}  // namespace prelight
