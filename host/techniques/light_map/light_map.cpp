#include "techniques/light_map/light_map.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <optional>

#include "cast/light_column.h"
#include "charts/even_places.h"
#include "charts/light_map_bake.h"
#include "charts/light_map_denoise.h"
#include "charts/vertex_irradiance.h"
#include "gi/indirect_light.h"
#include "options/rows.h"
#include "scene/surface/surface_regions.h"
#include "techniques/light_map/light_map_file.h"
#include "techniques/light_map/light_map_light.h"
#include "techniques/light_map/light_map_plan.h"
#include "techniques/light_map/light_map_sizing.h"
#include "techniques/projector.h"

namespace prelight {

namespace {

constexpr std::uint64_t mostReceivers = 8192;  // receivers that direct light is cast from at once

std::vector<PlannedPass> lightMapPasses(const PlanInput& input) {
  return planLightMap(input.scene, input.request);
}

/// Photons that leave lights for a map of so many texels.
std::uint64_t photonsFor(const BakeRequest& request, std::uint64_t texels) {
  if (request.lightMap.photons > 0) return request.lightMap.photons;
  return usualPhotons(texels) * (request.lightMap.denoise ? photonsForFilters : 1);
}

/// The texels, and the largest of what follows one another: direct light, then photons.
void addLightMapMemory(const PlanInput& input, Plan& plan) {
  if (!plan.runs(Pass::LightMap)) return;
  const int coefficients = lightMapCoefficients(plan);
  plan.hostBytes += lightMapBytes(input.scene, input.request, coefficients);
  const LightCounts lights = countLights(input.scene, {{"all", {"*"}}});
  const std::uint64_t direct =
      plan.runs(Pass::DirectLightOfTheMap)
          ? lightBlockBytesOf(lights.rays, lights.groups, static_cast<std::uint64_t>(coefficients),
                              mostReceivers)
          : 0;
  const std::uint64_t photons = photonsFor(input.request, mostTexels(input.scene, input.request));
  const std::uint64_t indirect =
      plan.runs(Pass::IndirectLightOfTheMap) ? indirectLightBytes(input.scene, photons) : 0;
  plan.deviceBytes += std::max(direct, indirect);
}

void addLightMapToKey(const BakeRequest& request, StateHash& hash) {
  hash.value(request.lightMap.wanted).value(request.lightMap.texelSize).value(request.lightMap.error);
  hash.value(request.lightMap.caustics).value(request.lightMap.photons);
  if (request.lightMap.denoise && request.lightMap.photons == 0) hash.value(true);  // more of them
}

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
    // Irradiance that radiosity has solved is kept.
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

  /// Estimates the error of the light that is shown, at a few places, with about a hundredth of the map's
  /// rays.
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

std::unique_ptr<Projector> makeLightMapProjector(const BakeContext& context) {
  if (!context.plan.runs(Pass::LightMap) || context.source == nullptr) return nullptr;
  return std::make_unique<LightMapProjector>(context);
}

/// Reads all entries together, when what is at vertices is known to fit.
class LightMapEntryReader final : public TechniqueReader {
 public:
  explicit LightMapEntryReader(const BakedInput& input) : input_(input) {}

  void finish(Bake& bake) override {
    bake.lightMap = readLightMap(input_.document, input_.root, input_.scene);
  }

 private:
  const BakedInput& input_;
};

void summarizeLightMap(const Bake& bake, std::size_t /*vertices*/, std::vector<BakedSummary>& found) {
  if (!bake.lightMap) return;
  const LightMap& map = *bake.lightMap;
  const LightMapLayout& layout = map.layout;
  const std::size_t bytes = bytesOf(map.values);
  found.push_back({"lightMap",
                   fmt::format("light map of {} x {} texels, {} charts, {} texels on the surface{}",
                               layout.width, layout.height, layout.chartCount, layout.texels.size(),
                               map.coefficients > 1 ? ", with radiance for bump maps" : ""),
                   bytes,
                   false,
                   {{"width", layout.width},
                    {"height", layout.height},
                    {"charts", layout.chartCount},
                    {"texels", layout.texels.size()},
                    {"coefficients", map.coefficients},
                    {"bytes", bytes}}});
}

void addLightMapArrays(const Bake& bake, std::vector<BakedArray>& arrays) {
  if (!bake.lightMap) return;
  const LightMap& map = *bake.lightMap;
  arrays.push_back({"lightMap",
                    fmt::format("[row {}][column {}][rgb][coefficient {}]", map.layout.height,
                                map.layout.width, map.coefficients),
                    {map.values}});
}

void setCaustics(BakeRequest& request, double value) {
  request.lightMap.caustics = value != 0.0;
  if (value != 0.0) request.lightMap.wanted = true;
}

constexpr Option<BakeRequest> caustics() {
  Option<BakeRequest> row = options::BakeRow::flag<&BakeRequest::lightMap, &LightMapRequest::caustics>(
      {.field = "LightMapRequest::caustics",
       .name = "caustics",
       .help = "light map with caustics, the light that mirrors and glass focus, from photons sent towards "
               "them"});
  row.set = setCaustics;
  return row;
}

constexpr auto lightMapOptions = std::to_array<Option<BakeRequest>>({
    options::BakeRow::flag<&BakeRequest::lightMap, &LightMapRequest::wanted>(
        {.field = "BakeRequest::lightMap",
         .name = "lightmap",
         .help = "light map: irradiance of the scene's own lights, direct and through all bounces, in an "
                 ".exr beside the file and at the vertices; charts are made for all meshes",
         .argument = "light_map"}),
    options::BakeRow::number<&BakeRequest::lightMap, &LightMapRequest::texelSize>(
        options::edge("chosen by the scene"),
        {.field = "LightMapRequest::texelSize",
         .name = "texel-size",
         .help = "light map: side of a texel, metres (default: such that there are 65 thousand texels, and "
                 "up to a million if the surface has many pieces); with a texel error the side of the "
                 "smallest",
         .unit = "m"}),
    options::BakeRow::number<&BakeRequest::lightMap, &LightMapRequest::error>(
        options::real(1e-4, 1, "texels of one size"),
        {.field = "LightMapRequest::error",
         .name = "texel-error",
         .help = "light map: choose a texel size for each chart, such that the rms error between texels is "
                 "about this share of the chart's mean light; the smallest texels are a quarter of the usual "
                 "size"}),
    options::BakeRow::flag<&BakeRequest::lightMap, &LightMapRequest::denoise>(
        {.field = "LightMapRequest::denoise",
         .name = "denoise",
         .help = "light map, and full shading of render: remove noise with Intel Open Image Denoise 2, whose "
                 "library must be installed or named by PRELIGHT_OIDN_LIBRARY"}),
    caustics(),
    options::BakeRow::number<&BakeRequest::lightMap, &LightMapRequest::photons>(
        options::whole(1, 1e9, "chosen by the texels"),
        {.field = "LightMapRequest::photons",
         .name = "photons",
         .help = "light map: photons that leave lights, and as many towards mirrors and glass (default: four "
                 "per texel, sixteen with denoising)"}),
});

}  // namespace

Technique lightMapTechnique() {
  return {.name = "lightmap",
          .options = {.rows = lightMapOptions, .behind = "sky"},
          .shading = &lightMapShading,
          .use = {.scattering = true, .lights = true},
          .plan = {.staticLight = true,
                   .passes = lightMapPasses,
                   .addMemory = addLightMapMemory,
                   .addToKey = addLightMapToKey},
          .makeProjector = makeLightMapProjector,
          .file = {.members = {"lightmap"},
                   .everywhere = false,
                   .accessors = {"texCoord", "indices"},
                   .makeReader = makeTechniqueReader<LightMapEntryReader>},
          .summarize = summarizeLightMap,
          .addArrays = addLightMapArrays,
          .exports = {.forms = {"lightmap", "probes"}}};
}

}  // namespace prelight
