#include "techniques/light_map/light_map_projector.h"

#include <algorithm>
#include <optional>

#include "charts/even_places.h"
#include "charts/light_map_bake.h"
#include "charts/light_map_denoise.h"
#include "charts/vertex_irradiance.h"
#include "techniques/light_map/light_map_plan.h"
#include "techniques/light_map/light_map_sizing.h"
#include "scene/surface_regions.h"

namespace prelight {

namespace {

class LightMapProjector final : public Projector {
 public:
  explicit LightMapProjector(const BakeContext& context)
      : context_(context), request_(withTexelEffort(context.scene, context.request)) {}

  std::string_view stage() const override { return "light map"; }

  void prepare(Progress& progress) override {
    BakeReport& report = context_.report;
    if (request_.lightMap.denoise)
      denoiser_.emplace(
          DenoiserOptions{.megabytes = denoiserMegabytes});  // before the first ray: it may be missing
    map_.emplace(
        context_.scene, context_.tracer,
        makeLightMapLayout(*context_.source, context_.scene, request_, context_.plan, context_.device,
                           context_.tracer, progress, report.lightMap.emplace(), report.rays),
        lightMapCoefficients(context_.plan));
    context_.clock.mark("layout");
  }

  void run(ReceiverCast* /*cast*/, Bake& bake, Progress& progress) override {
    LightMapSources sources(*context_.source, context_.scene, map_->layout(), request_, context_.plan,
                            lightMapCoefficients(context_.plan), context_.device, context_.tracer, progress);
    const std::uint64_t ofPhotons = sources.rays();
    map_->run(sources.parts(), progress);
    BakeReport& report = context_.report;
    bake.lightMap = finish(*report.lightMap, progress);
    report.lightMap->rays += ofPhotons;
    measureError(sources, *bake.lightMap, *report.lightMap, progress);
    report.rays += report.lightMap->rays;
    report.notes.push_back(noteOf(bake.lightMap->layout, *report.lightMap));
    if (!report.lightMap->replaced.empty()) report.notes.push_back(report.lightMap->replaced);
    // What was solved by radiosity comes first.
    if (!bake.irradiance)
      bake.irradiance = irradianceOfVertices(context_.scene, context_.mesh, *bake.lightMap, progress);
  }

 private:
  LightMap finish(LightMapReport& report, const Progress& progress) {
    if (!denoiser_) return map_->finish(usualCreaseAngle, report, {}, progress);
    context_.report.notes.push_back("light map denoised by " + denoiser_->name());
    return map_->finish(
        usualCreaseAngle, report, [&](LightMap& map) { denoiseLightMap(*denoiser_, progress, map); },
        progress);
  }

  /// Of what is shown, at a few places: a hundredth of the map's rays or so.
  void measureError(LightMapSources& sources, const LightMap& map, LightMapReport& report,
                    const Progress& progress) const {
    constexpr std::size_t mostPlaces = 512, texelsPerPlace = 200;
    const std::vector<LightMapTexel> places = evenPlaces(
        context_.scene, map.layout, std::min(mostPlaces, map.layout.texels.size() / texelsPerPlace));
    if (places.empty()) return;
    std::vector<LightMapTexel> again = places;
    for (LightMapTexel& place : again) place.texel += static_cast<std::uint32_t>(places.size());
    const std::uint64_t before = sources.rays();
    FoundTwice found;
    found.hidden.assign(places.size(), 0);
    found.values = {sources.irradiance(places, found.hidden, progress),
                    sources.irradiance(again, found.hidden, progress)};
    report.rays += sources.rays() - before;
    const ShownError error = errorOfShown(map, places, found);
    report.places = places.size();
    if (error.mean > 0.0) report.error = error.rms / error.mean;
  }

  const BakeContext& context_;
  BakeRequest request_;
  std::optional<LightMapBake> map_;
  std::optional<Denoiser> denoiser_;
};

}  // namespace

std::unique_ptr<Projector> lightMapProjector(const BakeContext& context) {
  if (!context.plan.runs(Pass::LightMap) || context.source == nullptr) return nullptr;
  return std::make_unique<LightMapProjector>(context);
}

}  // namespace prelight
