#include "techniques/bake_fit.h"
#include "techniques/shading.h"

namespace prelight {

/// This row checks and takes apertures alone: the row of ambient occlusion does so for the rest.
extern const ShadingInfo conesShading = {
    .shading = Shading::Cones,
    .summary = "sky, lights and reflections through the cone that is open above a surface",
    .bakeOption = "cones",
    .bakedName = "cones",
    .rules = {{"cone_ambient.glsl"}, Reflection::Everywhere, Through::None},
    .traits = {.skyLampsApart = true, .accessibility = true, .creaseCorrection = true},
    .error = {.sky = 0.06f, .outside = 0.024f, .inside = 0.064f},
    .carriedBy =
        [](const Bake& bake) {
          return !bake.ao.empty() && !bake.bentNormals.empty() && !bake.apertures.empty();
        },
    .askedBy = [](const BakeRequest& request) { return request.cones; },
    .addTo = [](BakeRequest& request, const BakeRequest&) { request.ao = request.cones = true; },
    .check =
        [](const Bake& bake, const CompiledScene& scene) {
          if (!bake.apertures.empty())
            requireCount("occlusion cones", bake.apertures.size(), scene.vertexCount());
        },
};

}  // namespace prelight
