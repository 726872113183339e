#include "techniques/bake_fit.h"
#include "techniques/shading.h"

namespace prelight {

extern const ShadingInfo radiosityShading = {
    .shading = Shading::Radiosity,
    .summary = "the scene's own lights as baked, with shadows and all diffuse bounces",
    .bakeOption = "radiosity",
    .bakedName = "radiosity",
    .rules = {Ambient::Transferred, Reflection::Metals, Through::AllLights},
    .traits = {.bakedLight = true, .followsLamps = true},
    .error = {.sky = 0.018f, .outside = 0.035f, .inside = 0.018f},
    .carriedBy = [](const Bake& bake) { return bake.irradiance.has_value(); },
    .askedBy = [](const BakeRequest& request) { return request.radiosity.wanted; },
    .addTo =
        [](BakeRequest& request, const BakeRequest& asked) {
          request.radiosity = asked.radiosity;
          request.radiosity.wanted = true;
        },
    .check =
        [](const Bake& bake, const CompiledScene& scene) {
          if (bake.irradiance) requireCount("irradiance", bake.irradiance->size(), scene.vertexCount());
        },
    .take = [](Bake& into, Bake& from) { takePart(into.irradiance, from.irradiance); },
    .encoded = Ambient::EncodedVertices,
};

}  // namespace prelight
