#include "integrators/global_illumination_renderer.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <memory>

#include "base/clocks.h"
#include "integrators/film.h"
#include "integrators/guide_tracer.h"
#include "integrators/path_tracer.h"
#include "integrators/spread_specks.h"
#include "scene/light_sources.h"

namespace prelight {

namespace {

/// Returns the width of a pixel's footprint in the middle of the scene, m.
double pixelFootprint(const CompiledScene& compiled, const Camera& camera, int height) {
  const glm::dvec3 centre = 0.5 * (glm::dvec3(compiled.boundsMin) + glm::dvec3(compiled.boundsMax));
  const double distance = glm::length(glm::dvec3(camera.world[3]) - compiled.origin - centre);
  const double half = camera.perspective ? distance * std::tan(0.5 * camera.yFov) : std::abs(camera.yMag);
  return 2.0 * half / height;
}

/// Share of the surface above which emitters count as large: they are close to the surfaces that they light.
constexpr double largeEmitters = 0.02;

double emitterShare(const CompiledScene& scene) {
  double all = 0.0, emitting = 0.0;
  for (std::uint32_t t = 0; t < scene.triangleCount(); ++t) {
    const double area = glm::length(geometricNormal(scene, t));
    all += area;
  }
  for (const Emitter& emitter : emittersOf(scene)) emitting += 2.0 * emitter.area;
  return all > 0.0 ? emitting / all : 0.0;
}

PlannedPass planRaysToLargeEmitters(const CompiledScene& compiled) {
  const bool meetsLights = emitterShare(compiled) > largeEmitters;
  return {Pass::RaysToLargeEmitters, meetsLights,
          meetsLights ? "emitters take more than a fiftieth of the surface: diffuse rays look for them, too"
                      : "emitters take less than a fiftieth of the surface: samples of them suffice"};
}

GlobalIllumination illuminate(const LitScene& lit, TransportScene& scene, const Camera& camera,
                              const GlobalIlluminationPictureRequest& request,
                              std::future<LitSurface> surface, const Device& device, Progress& progress) {
  GlobalIlluminationRequest light;
  light.indirect = request.indirect;
  light.indirect.seed = request.seed;
  light.indirect.photons = request.photonsOfIndirectLight(lit.scene.triangleCount());
  light.indirect.rays = request.raysOfTexels(lit.sky != nullptr);
  light.causticPhotons = request.photonsOfCaustics();
  if (request.photonsBy == PhotonChoice::Importance)
    light.eye = cameraAxes(camera, lit.scene, double(request.width) / request.height);
  light.footprint = pixelFootprint(lit.scene, camera, request.height);
  return computeGlobalIllumination(lit, scene, light, std::move(surface), device, progress);
}

void addTo(GlobalIlluminationPictureReport& report, const GlobalIllumination& light) {
  report.plan.insert(report.plan.end(), light.plan.begin(), light.plan.end());
  report.stageSeconds.insert(report.stageSeconds.end(), light.stageSeconds.begin(), light.stageSeconds.end());
  report.rays += light.rays;
  report.photons = light.indirectPhotons;
  report.causticPhotons = light.causticPhotons;
  report.texels = light.indirect.layout.texels.size();
  report.gatheredAt = light.gatheredAt;
}

/// Returns the irradiance of a map of one coefficient, [y][x], W/m2.
std::vector<glm::vec3> irradianceOf(const LightMap& map) {
  std::vector<glm::vec3> irradiance;
  for (std::size_t i = 0; i < map.values.size(); i += 3)
    irradiance.emplace_back(map.values[i], map.values[i + 1], map.values[i + 2]);
  return irradiance;
}

reference::ReferenceRequest pathsOf(const GlobalIlluminationPictureRequest& request) {
  reference::ReferenceRequest paths;
  paths.depth = request.depth;
  paths.samples = paths.samplesPerPass = request.samples;
  paths.seed = request.seed;
  paths.width = request.width;
  paths.height = request.height;
  paths.parts = request.parts;
  return paths;
}

Picture draw(const CompiledScene& compiled, TransportScene& scene, const Camera& camera,
             const reference::CachedLight& cached, const GlobalIlluminationPictureRequest& request,
             Progress& progress, GlobalIlluminationPictureReport& report) {
  const reference::ReferenceRequest paths = pathsOf(request);
  reference::PathTracer tracer(scene, compiled, camera, paths, &cached);
  reference::Film film(request.width, request.height, request.parts);
  std::vector<float> excess;
  while (film.passes == 0) {
    progress.report("picture", double(film.blockPixels) / double(film.pixelCount()));
    progress.check();
    const auto first = static_cast<std::uint32_t>(film.blockPixels);
    const std::vector<glm::vec4>& means = tracer.trace(
        0, first, std::min(tracer.blockPixels(), static_cast<std::uint32_t>(film.pixelCount()) - first));
    excess.insert(excess.end(), tracer.excess().begin(), tracer.excess().end());
    film.add(means, tracer.parts());
  }
  report.rays += tracer.rays();
  report.parts = film.partPictures();
  Picture picture = film.picture();
  if (!request.guides) spreadSpecks(excess, picture, report.parts);  // denoisers do better with all noise
  return picture;
}

std::uint64_t pixelsOf(const GlobalIlluminationPictureRequest& request) {
  return static_cast<std::uint64_t>(request.width) * static_cast<std::uint64_t>(request.height);
}

}  // namespace

std::uint32_t GlobalIlluminationPictureRequest::mapTexels(std::uint32_t triangles) const {
  const auto usual =
      std::clamp<std::uint64_t>(std::max<std::uint64_t>(pixelsOf(*this) / 32, triangles / 4), 4096, 65536);
  return texels.value_or(static_cast<std::uint32_t>(usual));
}

std::uint64_t GlobalIlluminationPictureRequest::photonsOfIndirectLight(std::uint32_t triangles) const {
  return indirect.photons.value_or(usualPhotons(mapTexels(triangles)));
}

std::uint32_t GlobalIlluminationPictureRequest::raysOfTexels(bool sky) const {
  constexpr std::uint32_t raysOfSample = 32, most = 8;
  if (gatherRays) return *gatherRays;
  if (!guides || sky) return indirect.rays;
  return std::clamp(std::bit_floor(raysOfSample * samples), indirect.rays, most * indirect.rays);
}

std::uint64_t GlobalIlluminationPictureRequest::photonsOfCaustics() const {
  return causticPhotons.value_or(std::clamp<std::uint64_t>(pixelsOf(*this), 160'000, 1'000'000));
}

Picture renderGlobalIllumination(const LitScene& lit, const Camera& camera,
                                 const GlobalIlluminationPictureRequest& request,
                                 std::future<LitSurface> surface, const Device& device, Progress& progress,
                                 GlobalIlluminationPictureReport& report) {
  StageClock stages(report.stageSeconds);
  // Few rays per picture: a better tree would take longer to build than it saves.
  Tracer tracer(lit.scene, device, BvhLayout::Automatic, BuildQuality::Balanced);
  TransportScene scene(lit, tracer);
  stages.mark("scene");
  const GlobalIllumination light =
      illuminate(lit, scene, camera, request, std::move(surface), device, progress);
  addTo(report, light);
  const PlannedPass toEmitters = planRaysToLargeEmitters(lit.scene);
  report.plan.insert(report.plan.end() - 1, toEmitters);
  stages.restart();
  IrradianceMap indirect(scene.context(), light.indirect.layout, light.patches);
  indirect.set(irradianceOf(light.indirect));
  const std::unique_ptr<CausticLight> caustics = makeCausticLight(light.caustics, light.surface, device);
  reference::CachedLight cached;
  cached.indirect = &indirect;
  cached.meetsLights = toEmitters.runs;
  cached.caustics = caustics.get();
  Picture picture = draw(lit.scene, scene, camera, cached, request, progress, report);
  stages.mark("picture");
  if (request.guides) {
    reference::GuideTracer guides(scene, lit.scene, camera, pathsOf(request));
    report.guides = guides.trace(1, progress);
    report.rays += guides.rays();
    stages.mark("guides");
  }
  return picture;
}

Picture renderGlobalIllumination(const Scene& scene, const LitScene& lit, const Camera& camera,
                                 const GlobalIlluminationPictureRequest& request, const Device& device,
                                 Progress& progress, GlobalIlluminationPictureReport& report) {
  return renderGlobalIllumination(
      lit, camera, request,
      std::async(
          std::launch::async,
          [&] { return layOutSurface(scene, lit.scene, request.mapTexels(lit.scene.triangleCount())); }),
      device, progress, report);
}

}  // namespace prelight
