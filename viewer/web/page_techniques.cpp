#include <algorithm>
#include <array>

#include "viewer/techniques/registry/techniques.h"
#include "viewer/web/page_parts.h"

namespace prelight::viewer {
namespace {

using Json = nlohmann::ordered_json;
using AddTransfer = Json (*)(const RenderInputs&, PageData&);

/// Something that a bake may hold.
struct BakedPart {
  const char* what;
  bool (*isIn)(const Bake&);
  Shading shading;       ///< that draws it
  AddTransfer add;       ///< its numbers; nullptr: pages leave it out
  const char* why = "";  ///< they do
};

template <Shading shading>
constexpr BakedPart drawn(const char* what, AddTransfer add, const char* why = "") {
  return {what, [](const Bake& bake) { return infoOf(shading).carriedBy(bake); }, shading, add, why};
}

/// All parts of a bake. Those that are drawn stand in the order of preference, as the first is shown first.
/// Data that belongs to another part (charts, other sides, shells of near lamps, keys) comes with that part.
constexpr std::array<BakedPart, 14> bakedParts = {{
    drawn<Shading::Sh>("SH transfer", pageSh),
    drawn<Shading::Ch>("CH transfer", pageCh),
    drawn<Shading::Glossy>("glossy transfer", pageGlossy),
    drawn<Shading::Haar>("wavelet transfer", pageHaar),
    drawn<Shading::Lights>("light groups", pageLightGroups),
    drawn<Shading::LightMap>("light map", pageLightMap),
    drawn<Shading::Radiosity>("radiosity", pageRadiosity),
    drawn<Shading::Vo>("vector occluders", pageOccluders),
    drawn<Shading::Cones>("cones", pageCones),
    drawn<Shading::Ao>("ambient occlusion", pageAo),
    drawn<Shading::Horizons>("horizons", nullptr, "pages draw no light above horizons"),
    {"volume", [](const Bake& bake) { return bake.volume.has_value(); }, Shading::Sh, nullptr,
     "a page has no moving objects that it could light"},
    {"encodings of the light map",
     [](const Bake& bake) { return bake.lightMap && !bake.lightMap->encoded.empty(); }, Shading::LightMap,
     nullptr, "pages show the light itself"},
    {"encodings of vertices' light", [](const Bake& bake) { return !bake.encodedLight.empty(); },
     Shading::Radiosity, nullptr, "pages show the light itself"},
}};

Json rulesJson(Shading shading, const RenderInputs& inputs) {
  const DrawingRules rules = rulesOf(shading, inputs);
  return {{"ambientRule", static_cast<int>(rules.ambient)},
          {"reflectionRule", static_cast<int>(rules.reflection)},
          {"throughRule", static_cast<int>(rules.through)}};
}

}  // namespace

void addTechniques(const RenderInputs& inputs, PageScene& page) {
  Json shown = Json::array(), leftOut = Json::array();
  for (const BakedPart& part : bakedParts) {
    if (!part.isIn(*inputs.bake)) continue;
    if (part.add == nullptr) {
      leftOut.push_back({{"what", part.what}, {"why", part.why}});
      continue;
    }
    const ShadingInfo& info = infoOf(part.shading);
    const std::size_t before = page.data.bytes().size();
    shown.push_back({{"name", info.name()},
                     {"label", info.summary},
                     {"rules", rulesJson(part.shading, inputs)},
                     {"transfer", part.add(inputs, page.data)}});
    shown.back()["bytes"] = page.data.bytes().size() - before;
  }
  page.description["techniques"] = shown;
  page.description["leftOut"] = leftOut;
  page.description["before"] = {{"name", "phong"}, {"rules", rulesJson(Shading::Phong, inputs)}};
}

}  // namespace prelight::viewer
