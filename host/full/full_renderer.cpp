#include "full/full_renderer.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <memory>

#include "lightmap/make_light_map_layout.h"
#include "photon/casters.h"
#include "photon/density_estimator.h"
#include "reference/film.h"
#include "reference/path_tracer.h"

namespace prelight {

namespace {

using Clock = std::chrono::steady_clock;

/// Of half the scene's diagonal: how far an estimate of caustics looks for photons.
constexpr double widestCaustic = 0.02;

class Stages {
 public:
  explicit Stages(FullReport& report) : report_(report) {}
  void mark(const char* name) {
    const Clock::time_point now = Clock::now();
    report_.stageSeconds.emplace_back(name, std::chrono::duration<double>(now - last_).count());
    last_ = now;
  }

 private:
  FullReport& report_;
  Clock::time_point last_ = Clock::now();
};

/// Photons that mirrors and glass have thrown onto other surfaces, ready to be looked up.
struct Caustics {
  DensityOptions options;
  DensityEstimator estimator;
  double radius = 0.0;
};

std::vector<PlannedPass> planOf(const TransportScene& scene, bool casters) {
  const bool lit = scene.lights().groupCount > 0;
  const bool scatters = scene.features().scatters;
  return {{"indirect light", lit && scatters,
           lit ? scatters ? "photons, density estimation and final gathering" : "no surface scatters light"
               : "nothing gives light"},
          {"caustic photons", lit && casters,
           casters ? lit ? "some surface is a mirror, glass or nearly a mirror" : "nothing gives light"
                   : "no surface is a mirror, glass or nearly a mirror"}};
}

std::unique_ptr<Caustics> traceCaustics(const CompiledScene& compiled, TransportScene& scene,
                                        const DensitySurface& surface, const FullRequest& request,
                                        const Device& device, Progress& progress, FullReport& report) {
  PhotonRequest photons;
  photons.kind = PhotonKind::Caustic;
  photons.photons = request.causticPhotons;
  photons.seed = request.seed + 1;
  photons.rouletteDepth = 8;
  PhotonHits hits;
  report.causticPhotons = PhotonTracer(compiled, scene).trace(photons, hits, progress);
  if (hits.photons.empty()) return nullptr;
  DensityOptions options;
  options.nearest = request.nearestCausticPhotons;
  const double radius = 0.5 * glm::length(glm::dvec3(compiled.boundsMax - compiled.boundsMin));
  auto caustics = std::make_unique<Caustics>(
      Caustics{options, DensityEstimator(surface, options, device), widestCaustic * radius});
  caustics->estimator.setPhotons(makePhotonMaps(hits.photons, surface));
  return caustics;
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

}  // namespace

Picture renderFull(const Scene& source, const LitScene& lit, const Camera& camera, const FullRequest& request,
                   const Device& device, Progress& progress, FullReport& report) {
  Stages stages(report);
  const CompiledScene& compiled = lit.scene;
  TransportScene scene(lit, device);
  report.plan = planOf(scene, !causticCasters(compiled).empty());
  stages.mark("scene");
  LightMapRequest map;
  map.texels = request.texels;
  const LightMapLayout layout = makeLightMapLayout(source, compiled, map);
  const SurfaceRegions regions = makeSurfaceRegions(compiled, map.creaseAngle);
  const DensitySurface surface = makeDensitySurface(compiled, regions);
  report.texels = layout.texels.size();
  stages.mark("layout");
  IrradianceMap indirect(scene.context(), layout);
  if (report.plan[0].runs) {
    IndirectLight light(compiled, scene, layout, surface, request.indirect, device, progress);
    stages.mark("photons");
    indirect.set(onGrid(layout, light.gather(layout.texels, progress)));
    report.photons = light.photons();
    report.rays += light.rays();
  } else {
    indirect.set(std::vector<glm::vec3>(layout.texelCount(), glm::vec3(0.0f)));
  }
  stages.mark("gather");
  std::unique_ptr<Caustics> caustics;
  if (report.plan[1].runs) {
    caustics = traceCaustics(compiled, scene, surface, request, device, progress, report);
    report.rays += report.causticPhotons.rays;
  }
  stages.mark("caustics");
  reference::CachedLight cached;
  cached.indirect = &indirect;
  if (caustics) {
    cached.caustics = &caustics->estimator;
    cached.causticOptions = caustics->options;
    cached.causticRadius = caustics->radius;
  }
  Picture picture = draw(compiled, scene, camera, cached, request, progress, report);
  stages.mark("picture");
  return picture;
}

}  // namespace prelight
