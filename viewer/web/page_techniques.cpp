#include <algorithm>
#include <numbers>

#include "basis/ch.h"
#include "occluders/occluder_places.h"
#include "occluders/occluder_upload.h"
#include "projectors/light_map/light_map_file.h"
#include "viewer/light_map_lighting.h"
#include "viewer/occluder_lighting.h"
#include "viewer/series_transfer.h"
#include "viewer/techniques.h"
#include "viewer/vertex_gloss.h"
#include "viewer/web/page_parts.h"

namespace prelight::viewer {
namespace {

using Json = nlohmann::ordered_json;

Json addSeries(const char* name, const HarmonicTransfer& transfer, PageData& data) {
  data.addHalves(name, transfer.coefficients);
  return {{"array", name}, {"order", transfer.order}, {"channels", transfer.channels}};
}

Json addSh(const Bake& bake, PageData& data) {
  return addSeries("sh", bake.sh ? *bake.sh : decompress(*bake.compressedSh), data);
}

Json addCh(const HarmonicTransfer& transfer, PageData& data) {
  Json json = addSeries("ch", transfer, data);
  data.addFloats("chBasis", std::span<const float>(chBasisTable(ch::Basis(transfer.order))));
  return json;
}

Json addGroups(const LightGroupTransfer& transfer, const CompiledScene& scene, PageData& data) {
  Json groups = Json::array();
  for (const LightGroup& group : transfer.groups)
    groups.push_back({{"name", group.name}, {"color", numbersOf(group.color)}});
  data.addHalves("groups", transfer.coefficients);
  std::vector<float> glow;
  for (const int group : glowGroups(transfer, scene)) glow.push_back(static_cast<float>(group));
  if (std::any_of(glow.begin(), glow.end(), [](float group) { return group >= 0.0f; }))
    data.addHalves("glowGroups", glow);
  return {{"array", "groups"}, {"groups", groups}, {"channels", transfer.channels}};
}

/// Irradiance alone, in place of what bumps make of it.
Json addLightMap(const LightMap& map, PageData& data) {
  data.addColors("lightMap", irradianceOf(map).pixels);
  data.addFloats("lightMapCorners", std::span<const glm::vec2>(lightMapCorners(map.layout)));
  return {{"width", map.layout.width}, {"height", map.layout.height}};
}

Json addRadiosity(std::span<const glm::vec3> irradiance, PageData& data) {
  std::vector<float> radiance;
  for (const glm::vec3& e : irradiance)
    for (int c = 0; c < 3; ++c) radiance.push_back(e[c] * std::numbers::inv_pi_v<float>);
  data.addHalves("radiosity", radiance);
  return {{"array", "radiosity"}};
}

Json addAo(const Bake& bake, PageData& data) {
  std::vector<float> open;
  for (std::size_t v = 0; v < bake.ao.size(); ++v) {
    const glm::vec3& bent = bake.bentNormals[v];
    open.insert(open.end(), {bent.x, bent.y, bent.z, bake.ao[v]});
  }
  data.addHalves("open", open);
  return {{"array", "open"}};
}

Json termsOf(const device::OccluderTerms& terms) {
  return {{"stored", terms.stored},
          {"stride", terms.stride},
          {"shadowStrength", terms.shadowStrength},
          {"causticStrength", terms.causticStrength},
          {"bleeding", terms.bleeding},
          {"diffuseFromSpecular", terms.diffuseFromSpecular},
          {"specularFromSpecular", terms.specularFromSpecular},
          {"specularExponent", terms.specularExponent}};
}

/// Places and distances as floats, the rest of a record as halves.
Json addOccluders(const RenderInputs& inputs, PageData& data) {
  const OccluderTransfer& transfer = *inputs.bake->occluders;
  const OccluderUpload upload(transfer, inputs.compiled.origin);
  const std::size_t length = upload.owners.empty() ? 1 : upload.records.size() / upload.owners.size();
  std::vector<glm::vec4> places;
  std::vector<float> vectors;
  for (std::size_t i = 0; i < upload.records.size(); ++i) {
    if (i % length == 0)
      places.push_back(upload.records[i]);
    else
      for (int k = 0; k < 4; ++k) vectors.push_back(upload.records[i][k]);
  }
  data.addWholes("occluderOffsets", transfer.offsets);
  data.addFloats("occluderPlaces", std::span<const glm::vec4>(places));
  data.addHalves("occluderVectors", vectors);
  data.addHalves("occluderOpen", occluderAccessibility(transfer));
  const std::vector<glm::vec4> gloss = vertexGloss(inputs, false);
  const bool shines = std::any_of(gloss.begin(), gloss.end(), [](const glm::vec4& g) {
    return std::max({g.x, g.y, g.z}) > 0.0f;
  });
  if (shines) data.addFloats("occluderGloss", std::span<const glm::vec4>(gloss));
  return {{"length", length}, {"shines", shines}, {"terms", termsOf(upload.terms({}, {}, 0))}};
}

/// What a shading draws from; null: a page does not draw it.
Json addTransfer(Shading shading, const RenderInputs& inputs, PageData& data) {
  const Bake& bake = *inputs.bake;
  switch (shading) {
    case Shading::Sh:
      return addSh(bake, data);
    case Shading::Ch:
      return addCh(*bake.ch, data);
    case Shading::Lights:
      return addGroups(*bake.lightGroups, inputs.compiled, data);
    case Shading::LightMap:
      return addLightMap(*bake.lightMap, data);
    case Shading::Radiosity:
      return addRadiosity(*bake.irradiance, data);
    case Shading::Vo:
      return addOccluders(inputs, data);
    case Shading::Ao:
      return addAo(bake, data);
    default:
      return {};
  }
}

/// Those that a page draws; the first that a bake holds is shown first.
constexpr std::array<Shading, 7> pageShadings = {Shading::Sh,       Shading::Ch,        Shading::Lights,
                                                 Shading::LightMap, Shading::Radiosity, Shading::Vo,
                                                 Shading::Ao};

Json rulesJson(Shading shading, const RenderInputs& inputs) {
  const DrawingRules rules = rulesOf(shading, inputs);
  return {{"ambientRule", static_cast<int>(rules.ambient)},
          {"reflectionRule", static_cast<int>(rules.reflection)},
          {"throughRule", static_cast<int>(rules.through)}};
}

}  // namespace

void addTechniques(const RenderInputs& inputs, PageScene& page) {
  Json list = Json::array();
  for (const Shading shading : pageShadings) {
    const ShadingInfo& info = infoOf(shading);
    if (!info.carriedBy(*inputs.bake)) continue;
    list.push_back({{"name", info.name},
                    {"label", info.summary},
                    {"rules", rulesJson(shading, inputs)},
                    {"transfer", addTransfer(shading, inputs, page.data)}});
  }
  page.description["techniques"] = list;
  page.description["before"] = {{"name", "phong"}, {"rules", rulesJson(Shading::Phong, inputs)}};
}

}  // namespace prelight::viewer
