#include "techniques/light_map/light_map_sizing.h"

#include <algorithm>

#include "charts/file_islands.h"
#include "charts/light_map_bake.h"
#include "charts/make_light_map_layout.h"
#include "charts/wall_search.h"
#include "techniques/light_map/light_map_plan.h"

namespace prelight {

namespace {

constexpr std::uint32_t texelsGatheredFrom = 1u << 14;
constexpr std::uint64_t shareOfRays = 4;

/// Asks whether to go on and keeps the work, but tells nobody where a pilot is.
class Quiet final : public Progress {
 public:
  explicit Quiet(const Progress& progress) : progress_(progress) {}
  bool stopRequested() const override { return progress_.stopRequested(); }
  WorkKeeper* keeper() const override { return progress_.keeper(); }

 private:
  const Progress& progress_;
};

BakeRequest pilotRequest(const BakeRequest& request, std::uint64_t index) {
  BakeRequest pilot = request;
  pilot.effort.rays = std::max<std::uint64_t>(1, request.effort.rays / shareOfRays);
  pilot.seed = request.seed ^ (0x9e3779b97f4a7c15u * (index + 1));
  return pilot;
}

LightMapLayout gatheredFrom(const Scene& source, const CompiledScene& scene) {
  LightMapLayoutRequest request;
  request.texels = texelsGatheredFrom;
  return makeLightMapLayout(source, scene, request);
}

TexelSizes sizeTexels(const Scene& source, const CompiledScene& scene, const LightMapCharts& charts,
                      const BakeRequest& request, const Plan& plan, const Device& device, Tracer& tracer,
                      Progress& progress, std::uint64_t& rays) {
  LightMapLayout layout = gatheredFrom(source, scene);
  findWalls(scene, tracer, layout);
  std::array<std::optional<LightMapSources>, 2> sources;
  for (std::size_t i = 0; i < 2; ++i)
    sources[i].emplace(source, scene, layout, pilotRequest(request, i), plan, 1, device, tracer, progress);
  rays += sources[0]->rays() + sources[1]->rays();
  Quiet quiet(progress);
  const PilotSource light = [&](const LightMapLayout& pilotLayout) {
    PilotLight pilot;
    for (std::size_t i = 0; i < 2; ++i) {
      LightMapBake bake(scene, tracer, pilotLayout, 1);
      bake.run(sources[i]->parts(), quiet);
      pilot.irradiance[i] = bake.values();
      pilot.hidden = bake.hidden();
      pilot.rays += bake.rays();
    }
    return pilot;
  };
  TexelSizes sizes = chooseTexelSizes(scene, charts, {request.lightMap.error, finestTexel(request, charts)},
                                      light, progress);
  rays += sizes.rays;
  return sizes;
}

}  // namespace

LightMapLayout makeLightMapLayout(const Scene& source, const CompiledScene& scene, const BakeRequest& request,
                                  const Plan& plan, const Device& device, Tracer& tracer, Progress& progress,
                                  LightMapReport& report, std::uint64_t& rays) {
  const LightMapCharts charts = makeLightMapCharts(source, scene, lightMapRequest(request));
  report.replaced = replacedText(charts.replaced);
  if (!plan.runs(Pass::TexelSizes)) return layOutLightMap(scene, charts);
  const TexelSizes sizes = sizeTexels(source, scene, charts, request, plan, device, tracer, progress, rays);
  report.sizes = reportOf(sizes, charts);
  return layOutLightMap(scene, charts, sizes.sizes);
}

}  // namespace prelight
