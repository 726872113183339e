#include "library/dark_bake.h"

#include <algorithm>
#include <vector>

#include "scene/dark_lamps.h"
#include "scene/light_sources.h"

namespace prelight {
namespace {

bool isBlack(const std::vector<glm::vec3>& values) {
  return std::none_of(values.begin(), values.end(), shines);
}

bool isBlack(const std::vector<float>& values) {
  return std::all_of(values.begin(), values.end(), [](float value) { return value == 0.0f; });
}

/// Returns the name of a black part, or nullptr if there is none.
const char* blackPart(const Bake& bake) {
  if (bake.lightMap && isBlack(bake.lightMap->values)) return "the light map";
  if (bake.irradiance && isBlack(*bake.irradiance)) return "the irradiance of vertices";
  if (bake.lightGroups && isBlack(bake.lightGroups->coefficients)) return "the light of the light groups";
  return nullptr;
}

}  // namespace

Warnings warningsOfDarkness(const Scene& scene, const CompiledScene& compiled, const Bake& bake,
                            const Environment* sky) {
  if (!bake.lightMap && !bake.irradiance && !bake.lightGroups) return {};
  if (const char* black = blackPart(bake)) return {darknessWarning(black, compiled, compiled.lights, sky)};
  return scene.sides.shutInLamps;
}

}  // namespace prelight
