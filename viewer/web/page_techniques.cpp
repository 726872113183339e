#include <algorithm>
#include <array>
#include <string>

#include "base/spans.h"
#include "viewer/core/render_inputs.h"
#include "viewer/web/page_parts.h"

namespace prelight::viewer {
namespace {

using Json = nlohmann::ordered_json;
using AddTransfer = Json (*)(const RenderInputs&, PageData&);

/// How pages get the numbers that a bake has for a shading.
struct PagePart {
  Shading shading;
  AddTransfer add;       ///< nullptr: pages leave it out
  const char* why = "";  ///< they do
};

/// Data that belongs to another part (charts, other sides, shells of near lamps, keys) comes with that part.
constexpr std::array<PagePart, 11> pageParts = {
    {{Shading::Sh, pageSh},
     {Shading::Ch, pageCh},
     {Shading::Glossy, pageGlossy},
     {Shading::Haar, pageHaar},
     {Shading::Lights, pageLightGroups},
     {Shading::LightMap, pageLightMap},
     {Shading::Radiosity, pageRadiosity},
     {Shading::Vo, pageOccluders},
     {Shading::Cones, pageCones},
     {Shading::Ao, pageAo},
     {Shading::Horizons, nullptr, "pages draw no light above horizons"}}};

Json pageVertexNumbers(const ShadingInfo& info, const RenderInputs& inputs, PageData& data) {
  const std::string array = std::string(info.name()) + "Numbers";
  data.addHalves(array, prelight::numbersOf(info.vertexNumbers(*inputs.bake, inputs.compiled)));
  return {{"array", array}};
}

/// Something that a bake may hold and no page draws.
struct LeftOutPart {
  const char* what;
  bool (*isIn)(const Bake&);
  const char* why;
};

constexpr std::array<LeftOutPart, 3> leftOutParts = {{
    {"volume", [](const Bake& bake) { return bake.volume.has_value(); },
     "a page has no moving objects that it could light"},
    {"encodings of the light map",
     [](const Bake& bake) { return bake.lightMap && !bake.lightMap->encoded.empty(); },
     "pages show the light itself"},
    {"encodings of vertices' light", [](const Bake& bake) { return !bake.encodedLight.empty(); },
     "pages show the light itself"},
}};

Json rulesJson(Shading shading, const RenderInputs& inputs) {
  const DrawingRules rules = rulesOf(shading, inputs);
  return {{"ambient", rules.ambient.file},
          {"takesLamps", infoOf(shading).traits.skyLampsApart},
          {"reflectionRule", static_cast<int>(rules.reflection)},
          {"throughRule", static_cast<int>(rules.through)}};
}

}  // namespace

void addTechniques(const RenderInputs& inputs, PageScene& page) {
  Json shown = Json::array(), leftOut = Json::array();
  for (const Shading shading : shadingsByPreference()) {
    const ShadingInfo& info = infoOf(shading);
    if (info.bakeOption.empty() || !info.carriedBy(*inputs.bake)) continue;
    const auto part = std::ranges::find(pageParts, shading, &PagePart::shading);
    const bool hasPart = part != pageParts.end() && part->add != nullptr;
    if (!hasPart && info.vertexNumbers == nullptr) {
      leftOut.push_back({{"what", info.bakedName}, {"why", part == pageParts.end() ? "" : part->why}});
      continue;
    }
    const std::size_t before = page.data.bytes().size();
    shown.push_back(
        {{"name", info.name()},
         {"label", info.summary},
         {"rules", rulesJson(shading, inputs)},
         {"transfer", hasPart ? part->add(inputs, page.data) : pageVertexNumbers(info, inputs, page.data)}});
    shown.back()["bytes"] = page.data.bytes().size() - before;
  }
  for (const LeftOutPart& part : leftOutParts)
    if (part.isIn(*inputs.bake)) leftOut.push_back({{"what", part.what}, {"why", part.why}});
  page.description["techniques"] = shown;
  page.description["leftOut"] = leftOut;
  page.description["before"] = {{"name", "phong"}, {"rules", rulesJson(Shading::Phong, inputs)}};
}

}  // namespace prelight::viewer
