#include "techniques/bake_fit.h"
#include "techniques/light_map/light_map_fit.h"
#include "techniques/shading.h"

namespace prelight {

void requireLightMap(const LightMap& map, const CompiledScene& scene) {
  requireCount("faces of the light map", map.layout.chartOf.size(), 2 * std::size_t{scene.triangleCount()});
  requireCount("light map", map.values.size(),
               3 * map.layout.texelCount() * static_cast<std::size_t>(map.coefficients));
}

extern const ShadingInfo lightMapShading = {
    .shading = Shading::LightMap,
    .summary = "the scene's own lights as baked in a light map",
    .bakeOption = "lightmap",
    .bakedName = "light map",
    .rules = {{"light_map_ambient.glsl", true}, Reflection::Metals, Through::AllLights},
    .traits = {.bakedLight = true},
    .error = {.sky = 0.004f, .outside = 0.003f, .inside = 0.004f},
    .carriedBy = [](const Bake& bake) { return bake.lightMap.has_value(); },
    .askedBy = [](const BakeRequest& request) { return request.lightMap.wanted; },
    .addTo =
        [](BakeRequest& request, const BakeRequest& asked) {
          request.lightMap = asked.lightMap;
          request.lightMap.wanted = true;
        },
    .check =
        [](const Bake& bake, const CompiledScene& scene) {
          if (bake.lightMap) requireLightMap(*bake.lightMap, scene);
        },
    .take = [](Bake& into, Bake& from) { takePart(into.lightMap, from.lightMap); },
    .encoded = Ambient::EncodedMap,
};

}  // namespace prelight
