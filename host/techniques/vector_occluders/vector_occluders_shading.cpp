#include <string>

#include "occluders/occluder_record.h"
#include "prelight/error.h"
#include "techniques/bake_fit.h"
#include "techniques/shading.h"

namespace prelight {
namespace {

void checkOccluders(const Bake& bake, const CompiledScene& scene) {
  if (!bake.occluders) return;
  const OccluderTransfer& occluders = *bake.occluders;
  requireCount("vector occluders", occluders.offsets.size(), std::size_t{scene.vertexCount()} + 1);
  requireCount("vector occluders", occluders.vectors.size(),
               occluders.recordCount() * occluders.stored.size());
  for (const OccluderVector needed : {OccluderVector::Position, OccluderVector::Occlusion,
                                      OccluderVector::DiffuseNormal, OccluderVector::DiffuseColor})
    if (placeOf(occluders, needed) == occluders.stored.size())
      throw Error(ExitCode::RuntimeFailure, "vector occluders",
                  "the bake has no " + std::string(occluderVectorNames[static_cast<std::size_t>(needed)]),
                  "bake this scene again");
}

}  // namespace

extern const ShadingInfo occluderShading = {
    .shading = Shading::Vo,
    .summary = "lights anywhere, with the shadows and colours of vector occluders",
    .bakeOption = "vo",
    .bakedName = "vector occluders",
    .rules = {Ambient::Transferred, Reflection::Metals, Through::AllLights},
    .traits = {.shadowsOfItsOwn = true,
               .areaLightsAsSamples = true,
               .followsAnimation = true,
               .movableNodes = true},
    .error = {.sky = 0.03f, .outside = 0.02f, .inside = 0.065f},
    .carriedBy = [](const Bake& bake) { return bake.occluders.has_value(); },
    .askedBy = [](const BakeRequest& request) { return request.occluders.wanted; },
    .addTo =
        [](BakeRequest& request, const BakeRequest& asked) {
          request.occluders = asked.occluders;
          request.occluders.wanted = true;
        },
    .check = checkOccluders,
    .take = [](Bake& into, Bake& from) { takePart(into.occluders, from.occluders); },
};

}  // namespace prelight
