#include "techniques/registry/registry.h"

#include <algorithm>
#include <span>
#include <string_view>
#include <vector>

#include "options/shared_bake_options.h"
#include "prelight/options.h"
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
#include "techniques/shading.h"
#include "techniques/subsurface/subsurface.h"
#include "techniques/thickness/thickness.h"
#include "techniques/vector_occluders/vector_occluders.h"
#include "techniques/volume/volume.h"

namespace prelight {

namespace {

using OptionRows = std::vector<Option<BakeRequest>>;

OptionRows orderedOptions() {
  OptionRows options;
  for (const Technique& technique : techniques()) {
    const auto& [rows, behind] = technique.options;
    auto at = std::ranges::find(options, behind, [](const auto& row) { return std::string_view(row.name); });
    if (at != options.end()) ++at;
    options.insert(at, rows.begin(), rows.end());
  }
  return options;
}

OptionRows allOptions() {
  OptionRows options = orderedOptions();
  for (const auto rows : {lightOptions(), prelight::castOptions()})
    options.insert(options.end(), rows.begin(), rows.end());
  return options;
}

}  // namespace

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
      thicknessTechnique(),
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

std::span<const Option<BakeRequest>> techniqueOptions() {
  static const OptionRows options = orderedOptions();
  return options;
}

template <>
std::span<const Option<BakeRequest>> optionsOf<BakeRequest>() {
  static const OptionRows options = allOptions();
  return options;
}

void checkBake(const Bake& bake, const CompiledScene& scene) {
  for (const Technique& technique : techniques()) {
    if (technique.shading != nullptr) technique.shading->check(bake, scene);
    if (technique.part != nullptr) technique.part->check(bake, scene);
  }
}

void takeBake(Bake& into, Bake&& from) {
  for (const Technique& technique : techniques()) {
    if (technique.shading != nullptr) technique.shading->take(into, from);
    if (technique.part != nullptr) technique.part->take(into, from);
  }
}

void addParts(BakeRequest& request, const BakeRequest& asked) {
  for (const Technique& technique : techniques())
    if (technique.part != nullptr) technique.part->addTo(request, asked);
}

}  // namespace prelight
