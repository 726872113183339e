#include "gi/full_light.h"

#include "base/stage_clock.h"
#include "gi/light_passes.h"
#include "lightmap/back_charts.h"
#include "lightmap/light_map_bake.h"
#include "lightmap/make_light_map_layout.h"
#include "photon/caustic_light.h"
#include "photon/photon_tracer.h"

namespace prelight {

void setIrradiance(std::span<const glm::vec3> irradiance, LightMap& map) {
  std::vector<std::uint8_t> hidden(irradiance.size());
  for (std::size_t i = 0; i < irradiance.size(); ++i) {
    hidden[i] = irradiance[i] == glm::vec3(0.0f) ? 1 : 0;
    for (int c = 0; c < 3; ++c)
      map.values[3 * std::size_t{map.layout.texels[i].texel} + static_cast<std::size_t>(c)] =
          irradiance[i][c];
  }
  fillHidden(hidden, map);
}

FullLight makeFullLight(const Scene& source, const LitScene& lit, const FullLightRequest& request,
                        const Device& device, Progress& progress) {
  FullLight full;
  StageClock stages(full.stageSeconds);
  const CompiledScene& compiled = lit.scene;
  TransportScene scene(lit, device);
  full.plan = lightPasses(compiled, scene);
  LightMapRequest map;
  map.texels = request.texels;
  IndirectRequest indirect = request.indirect;
  indirect.seed = request.seed;
  SentPhotons photons;
  if (full.plan[0].runs) photons = sendIndirectPhotons(compiled, scene, indirect, progress);
  stages.mark("photons");
  const LightMapCharts charts = makeLightMapCharts(source, compiled, map);
  full.indirect.layout = layOutLightMap(compiled, charts);
  full.plan.push_back(planBacks(addBacks(compiled, charts, photons.hits.backs, full.indirect.layout)));
  full.indirect.values.assign(3 * full.indirect.layout.texelCount(), 0.0f);
  const DensitySurface surface = makeDensitySurface(compiled, makeSurfaceRegions(compiled, map.creaseAngle));
  stages.mark("layout");
  if (full.plan[0].runs) {
    IndirectLight light(lit, scene, full.indirect.layout, surface, indirect, device, photons);
    setIrradiance(light.gather(full.indirect.layout.texels, progress), full.indirect);
    full.indirectPhotons = light.photons();
    full.rays += light.rays();
    stages.mark("gather");
  }
  if (full.plan[1].runs) {
    PhotonHits hits;
    full.causticPhotons =
        PhotonTracer(compiled, scene)
            .trace(causticRequest(request.causticPhotons, request.seed + 1), hits, progress);
    full.rays += full.causticPhotons.rays;
    full.photons = std::move(hits.photons);
    if (!full.photons.empty()) full.filter = chooseCausticFilter(makePhotonMaps(full.photons, surface));
    stages.mark("caustics");
  }
  return full;
}

}  // namespace prelight
