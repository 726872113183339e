#include "integrators/full_renderer.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "base/stage_clock.h"
#include "gi/full_light.h"
#include "gi/light_passes.h"
#include "integrators/film.h"
#include "integrators/path_tracer.h"
#include "lightmap/back_charts.h"
#include "lightmap/make_light_map_layout.h"
#include "photon/caustic_light.h"
#include "scene/light_sources.h"

namespace prelight {

namespace {

/// Width of what a pixel sees in the middle of the scene, m.
double pixelFootprint(const CompiledScene& compiled, const Camera& camera, int height) {
  const glm::dvec3 centre = 0.5 * (glm::dvec3(compiled.boundsMin) + glm::dvec3(compiled.boundsMax));
  const double distance = glm::length(glm::dvec3(camera.world[3]) - compiled.origin - centre);
  const double half = camera.perspective ? distance * std::tan(0.5 * camera.yFov) : std::abs(camera.yMag);
  return 2.0 * half / height;
}

/// Of the surface: emitters that take more of it are near what they light, seldom far.
constexpr double largeEmitters = 0.02;

double emitterShare(const CompiledScene& scene) {
  double all = 0.0, emitting = 0.0;
  for (std::uint32_t t = 0; t < scene.triangleCount(); ++t) {
    const double area = glm::length(geometricNormal(scene, t));
    all += area;
    if (shines(scene.materials[scene.triangleMaterials[t]].emission)) emitting += area;
  }
  return all > 0.0 ? emitting / all : 0.0;
}

std::vector<PlannedPass> planOf(const CompiledScene& compiled, const TransportScene& scene) {
  const bool meetsLights = emitterShare(compiled) > largeEmitters;
  std::vector<PlannedPass> plan = lightPasses(compiled, scene);
  plan.push_back({Pass::RaysToLargeEmitters, meetsLights,
                  meetsLights
                      ? "emitters take more than a fiftieth of the surface: diffuse rays look for them, too"
                      : "emitters take less than a fiftieth of the surface: samples of them suffice"});
  return plan;
}

/// Indirect light of a layout's texels on its grid, see setIrradiance().
std::vector<glm::vec3> filledGrid(const LightMapLayout& layout, std::span<const glm::vec3> irradiance) {
  LightMap map;
  map.layout = layout;
  map.values.assign(3 * layout.texelCount(), 0.0f);
  setIrradiance(irradiance, map);
  std::vector<glm::vec3> grid;
  for (std::size_t t = 0; t < layout.texelCount(); ++t)
    grid.emplace_back(map.values[3 * t], map.values[3 * t + 1], map.values[3 * t + 2]);
  return grid;
}

Picture draw(const CompiledScene& compiled, TransportScene& scene, const Camera& camera,
             const reference::CachedLight& cached, const FullRequest& request, Progress& progress,
             FullReport& report) {
  reference::ReferenceRequest paths;
  paths.depth = request.depth;
  paths.samples = paths.samplesPerPass = request.samples;
  paths.seed = request.seed;
  paths.width = request.width;
  paths.height = request.height;
  reference::PathTracer tracer(scene, compiled, camera, paths, &cached);
  reference::Film film(request.width, request.height);
  while (film.passes == 0) {
    progress.report("picture", double(film.blockPixels) / double(film.pixelCount()));
    progress.check();
    const auto first = static_cast<std::uint32_t>(film.blockPixels);
    film.add(tracer.trace(
        0, first, std::min(tracer.blockPixels(), static_cast<std::uint32_t>(film.pixelCount()) - first)));
  }
  report.rays += tracer.rays();
  return film.picture();
}

std::uint64_t pixelsOf(const FullRequest& request) {
  return static_cast<std::uint64_t>(request.width) * static_cast<std::uint64_t>(request.height);
}

}  // namespace

std::uint32_t FullRequest::mapTexels() const {
  const auto usual = std::clamp<std::uint64_t>(pixelsOf(*this) / 32, 4096, 65536);
  return texels.value_or(static_cast<std::uint32_t>(usual));
}

std::uint64_t FullRequest::photonsOfCaustics() const {
  return causticPhotons.value_or(std::clamp<std::uint64_t>(pixelsOf(*this), 160'000, 1'000'000));
}

FullSurface makeFullSurface(const Scene& scene, const CompiledScene& compiled, const FullRequest& request) {
  LightMapRequest map;
  map.texels = request.mapTexels();
  FullSurface surface;
  surface.density = makeDensitySurface(compiled, makeSurfaceRegions(compiled, map.creaseAngle));
  surface.charts = makeLightMapCharts(scene, compiled, map);
  surface.layout = layOutLightMap(compiled, surface.charts);
  return surface;
}

Picture renderFull(const LitScene& lit, const Camera& camera, const FullRequest& request,
                   std::future<FullSurface> comingSurface, const Device& device, Progress& progress,
                   FullReport& report) {
  StageClock stages(report.stageSeconds);
  const CompiledScene& compiled = lit.scene;
  // A picture sends few rays: a better tree takes longer to build than it saves.
  Tracer tracer(compiled, device, BvhLayout::Automatic, BuildQuality::Balanced);
  TransportScene scene(lit, tracer);
  report.plan = planOf(compiled, scene);
  stages.mark("scene");
  const bool indirectRuns = report.plan[0].runs, causticsRun = report.plan[1].runs;
  SentPhotons photons, causticPhotons;
  if (indirectRuns) photons = sendIndirectPhotons(compiled, scene, request.indirect, progress);
  if (causticsRun)
    causticPhotons.report = PhotonTracer(compiled, scene)
                                .trace(causticRequest(request.photonsOfCaustics(), request.seed + 1),
                                       causticPhotons.hits, progress);
  report.photons = photons.report;
  report.causticPhotons = causticPhotons.report;
  stages.mark("photons");
  FullSurface surface = comingSurface.get();
  report.plan.push_back(planBacks(addBacks(compiled, surface.charts, photons.hits.backs, surface.layout)));
  report.texels = surface.layout.texels.size();
  stages.mark("layout");
  IrradianceMap indirect(scene.context(), surface.layout);
  std::vector<glm::vec3> irradiance(surface.layout.texelCount(), glm::vec3(0.0f));
  report.rays += causticPhotons.report.rays;
  if (indirectRuns) {
    IndirectLight light(lit, scene, surface.layout, surface.density, request.indirect, device, photons);
    irradiance = filledGrid(surface.layout, light.gather(surface.layout.texels, progress));
    report.rays += light.rays();
  }
  indirect.set(irradiance);
  stages.mark("gather");
  const std::unique_ptr<CausticLight> caustics = makeCausticLight(
      causticPhotons.hits.photons, surface.density, pixelFootprint(compiled, camera, request.height), device);
  stages.mark("caustics");
  reference::CachedLight cached;
  cached.indirect = &indirect;
  cached.meetsLights = report.plan[2].runs;
  cached.caustics = caustics.get();
  Picture picture = draw(compiled, scene, camera, cached, request, progress, report);
  stages.mark("picture");
  return picture;
}

Picture renderFull(const Scene& scene, const LitScene& lit, const Camera& camera, const FullRequest& request,
                   const Device& device, Progress& progress, FullReport& report) {
  return renderFull(
      lit, camera, request,
      std::async(std::launch::async, [&] { return makeFullSurface(scene, lit.scene, request); }), device,
      progress, report);
}

}  // namespace prelight
