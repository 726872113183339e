#include "techniques/registry/registry.h"

#include "techniques/ambient_occlusion/ambient_occlusion.h"
#include "techniques/ch/ch.h"
#include "techniques/chart_transfer/chart_transfer.h"
#include "techniques/encoded_light/encoded_light.h"
#include "techniques/glossy/glossy.h"
#include "techniques/haar/haar.h"
#include "techniques/horizons/horizons.h"
#include "techniques/light_groups/light_groups.h"
#include "techniques/light_map/light_map.h"
#include "techniques/near_lamps/near_lamps.h"
#include "techniques/occlusion_cones/occlusion_cones.h"
#include "techniques/radiosity/radiosity.h"
#include "techniques/sh/sh.h"
#include "techniques/subsurface/subsurface.h"
#include "techniques/vector_occluders/vector_occluders.h"
#include "techniques/volume/volume.h"

namespace prelight {

const std::vector<Technique>& techniques() {
  static const std::vector<Technique> rows = {
      ambientOcclusionTechnique(),
      shTechnique(),
      compressedShTechnique(),
      animationTechnique(),
      chTechnique(),
      lightGroupsTechnique(),
      haarTechnique(),
      glossyTechnique(),
      vectorOccludersTechnique(),
      volumeTechnique(),
      chartTransferTechnique(),
      radiosityTechnique(),
      lightMapTechnique(),        // keeps the irradiance that radiosity has solved
      encodedLightTechnique(),    // encodes the light map
      occlusionConesTechnique(),  // from ambient occlusion
      nearLampsTechnique(),
      horizonsTechnique(),
      subsurfaceTechnique(),
  };
  return rows;
}

std::vector<BakedSummary> summariesOf(const Bake& bake, std::size_t vertices) {
  std::vector<BakedSummary> summaries;
  for (const Technique& technique : techniques())
    if (technique.summarize != nullptr) technique.summarize(bake, vertices, summaries);
  return summaries;
}

std::vector<BakedArray> arraysOf(const Bake& bake) {
  std::vector<BakedArray> arrays;
  for (const Technique& technique : techniques())
    if (technique.addArrays != nullptr) technique.addArrays(bake, arrays);
  return arrays;
}

}  // namespace prelight
