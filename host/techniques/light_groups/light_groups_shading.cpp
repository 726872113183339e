#include "techniques/bake_fit.h"
#include "techniques/shading.h"

namespace prelight {
namespace {

void checkLightGroups(const Bake& bake, const CompiledScene& scene) {
  const auto& lights = bake.lightGroups;
  if (!lights) return;
  const auto groups = static_cast<int>(lights->groups.size());
  requireCount("light groups", lights->coefficients.size(),
               rowNumbers(scene.vertexCount(), lights->channels, groups, 1));
}

VertexRows lightGroupRows(const Bake& bake) {
  if (!bake.lightGroups) return {};
  return {bake.lightGroups->coefficients,
          bake.lightGroups->groups.size() * static_cast<std::size_t>(bake.lightGroups->channels)};
}

}  // namespace

extern const ShadingInfo lightsShading = {
    .shading = Shading::Lights,
    .summary = "the scene's own lights, with shadows",
    .bakeOption = "light-groups",
    .bakedName = "light groups",
    .rules = {Ambient::Transferred, Reflection::Metals, Through::AllLights},
    .traits = {.bounces = true, .bouncesOfLamps = true, .objectsInCubes = true},
    .error = {.sky = 0.5f, .outside = 0.033f, .inside = 0.02f},
    .carriedBy = [](const Bake& bake) { return bake.lightGroups.has_value(); },
    .askedBy = [](const BakeRequest& request) { return request.lightGroups.wanted; },
    .addTo =
        [](BakeRequest& request, const BakeRequest& asked) {
          request.lightGroups = asked.lightGroups;
          request.lightGroups.wanted = true;
        },
    .check = checkLightGroups,
    .take = [](Bake& into, Bake& from) { takePart(into.lightGroups, from.lightGroups); },
    .changingRows = lightGroupRows,
};

}  // namespace prelight
