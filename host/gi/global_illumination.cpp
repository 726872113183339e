#include "gi/global_illumination.h"

#include <fmt/format.h>

#include <algorithm>

#include "base/clocks.h"
#include "charts/irradiance/hollows.h"
#include "charts/light_map_charts.h"
#include "charts/make_light_map_layout.h"
#include "charts/wall_search.h"
#include "gi/surface_patches.h"
#include "photon/importons.h"
#include "photon/photon_sources.h"

namespace prelight {

std::vector<PlannedPass> planGlobalIllumination(const CompiledScene& compiled, const TransportScene& scene) {
  const bool lit = scene.lights().groupCount > 0;
  const bool scatters = scene.features().scatters;
  const bool casters = !causticCasters(compiled).empty();
  return {{Pass::IndirectLight, lit && scatters,
           !lit       ? "nothing gives light"
           : scatters ? "photons, density estimation and final gathering"
                      : "no surface scatters light"},
          {Pass::CausticPhotons, lit && casters,
           !casters ? "no surface is a mirror, glass or nearly a mirror"
           : lit    ? "some surface is a mirror, glass or nearly a mirror"
                    : "nothing gives light"}};
}

bool runs(std::span<const PlannedPass> plan, Pass pass) {
  return std::any_of(plan.begin(), plan.end(), [pass](const PlannedPass& planned) {
    return planned.name == pass.name && planned.runs;
  });
}

LitSurface layOutSurface(const Scene& source, const CompiledScene& compiled, std::uint32_t texels) {
  LightMapLayoutRequest map;
  map.texels = texels;
  map.wideMetals = true;
  LitSurface surface;
  surface.density = makeDensitySurface(compiled, makeSurfaceRegions(compiled, map.creaseAngle));
  surface.charts = makeLightMapCharts(source, compiled, map);
  surface.layout = layOutLightMap(compiled, surface.charts);
  return surface;
}

namespace {

/// Adds texels for the backs of one-sided surfaces that photons have met.
PlannedPass addMetBacks(const CompiledScene& compiled, std::span<const std::uint8_t> met,
                        LitSurface& surface) {
  const std::uint32_t charts = addBacks(compiled, surface.charts, met, surface.layout);
  return {Pass::BacksOfOneSidedSurfaces, charts > 0,
          charts > 0 ? fmt::format("photons met them: {} charts have texels on their backs, too", charts)
                     : "no photon met one: their backs have no texels"};
}

}  // namespace

GlobalIllumination computeGlobalIllumination(const LitScene& lit, TransportScene& scene,
                                             const GlobalIlluminationRequest& request,
                                             std::future<LitSurface> comingSurface, const Device& device,
                                             Progress& progress) {
  const CompiledScene& compiled = lit.scene;
  GlobalIllumination light;
  StageClock stages(light.stageSeconds);
  light.plan = planGlobalIllumination(compiled, scene);
  const bool indirectRuns = runs(light.plan, Pass::IndirectLight),
             causticsRun = runs(light.plan, Pass::CausticPhotons);

  SentPhotons sent, sentCaustics;
  if (indirectRuns) {
    const PhotonRequest photons = indirectPhotons(scene, request.indirect);
    sent = request.eye ? sendByImportance(compiled, scene, *request.eye, photons, progress)
                       : sendPhotons(compiled, scene, photons, progress);
  }
  if (causticsRun)
    sentCaustics = sendPhotons(compiled, scene,
                               causticRequest(request.causticPhotons, request.indirect.seed + 1), progress);
  light.indirectPhotons = sent.report;
  light.causticPhotons = sentCaustics.report;
  light.rays = sentCaustics.report.rays;
  stages.mark("photons");

  LitSurface surface = comingSurface.get();
  light.plan.push_back(addMetBacks(compiled, sent.hits.backs, surface));
  stages.mark("layout");

  if (indirectRuns || causticsRun) {
    leaveHollows(compiled, scene.tracer(), surface.layout);
    findWalls(compiled, scene.tracer(), surface.layout);
  }
  const SurfacePatches patches(compiled, scene.tracer(), std::move(surface.layout), surface.density);
  stages.mark("walls");

  light.indirect.layout = patches.layout();
  light.indirect.values.assign(3 * light.indirect.layout.texelCount(), 0.0f);
  if (indirectRuns) {
    IndirectLight indirect(lit, scene, patches, surface.density, request.indirect, device, sent, progress);
    setIrradiance(indirect.gatherSurface(progress), light.indirect);
    fillBlack(light.indirect);
    light.rays += indirect.rays();
    light.gatheredAt = indirect.records();
  }
  stages.mark("gather");

  light.photons = std::move(sentCaustics.hits.photons);
  light.caustics = makeCausticMap(patches.sort(light.photons), request.footprint);
  if (!light.photons.empty() && !patches.areRegions())
    light.patches = patches.at(light.indirect.layout.texels);
  light.surface = std::move(surface.density);
  stages.mark("caustics");
  return light;
}

GlobalIllumination computeGlobalIllumination(const Scene& source, const LitScene& lit,
                                             const GlobalIlluminationRequest& request, std::uint32_t texels,
                                             const Device& device, Progress& progress) {
  std::future<LitSurface> surface =
      std::async(std::launch::async, [&, texels] { return layOutSurface(source, lit.scene, texels); });
  TransportScene scene(lit, device);
  return computeGlobalIllumination(lit, scene, request, std::move(surface), device, progress);
}

}  // namespace prelight
