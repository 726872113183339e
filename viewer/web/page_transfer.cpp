#include <algorithm>
#include <cmath>
#include <numbers>

#include "basis/ch.h"
#include "occluders/occluder_record.h"
#include "occluders/occluder_upload.h"
#include "techniques/chart_transfer/chart_places.h"
#include "techniques/light_map/light_map_file.h"
#include "techniques/near_lamps/lamp_shells.h"
#include "viewer/techniques/glossy/glossy_lighting.h"
#include "viewer/techniques/glossy/measured_lobes.h"
#include "viewer/techniques/glossy/specular_lobes.h"
#include "viewer/techniques/light_map/light_map_lighting.h"
#include "viewer/techniques/series/chart_lighting.h"
#include "viewer/techniques/series/series_transfer.h"
#include "viewer/techniques/vector_occluders/occluder_lighting.h"
#include "viewer/techniques/vector_occluders/vertex_gloss.h"
#include "viewer/web/page_parts.h"
namespace prelight::viewer {
namespace {

using Json = nlohmann::ordered_json;

/// Coefficients of a vertex and channel, wherever they are: of a form that has fewer, those that are left are
/// 0, and one channel is that of all.
float coefficientOf(const HarmonicTransfer& transfer, std::size_t vertex, int channel, std::size_t i) {
  const auto length = static_cast<std::size_t>(transfer.order * transfer.order);
  if (i >= length) return 0.0f;
  const std::size_t row = vertex * static_cast<std::size_t>(transfer.channels) +
                          static_cast<std::size_t>(std::min(channel, transfer.channels - 1));
  return transfer.coefficients[row * length + i];
}

std::size_t verticesOf(const HarmonicTransfer& transfer) {
  return transfer.coefficients.size() /
         static_cast<std::size_t>(transfer.channels * transfer.order * transfer.order);
}

/// Accessibility of fronts, each beside that of the other side: [vertex][side].
HarmonicTransfer bothSides(const HarmonicTransfer& fronts, const HarmonicTransfer& through) {
  HarmonicTransfer both{
      std::max(fronts.order, through.order), std::max(fronts.channels, through.channels), fronts.bounces, {}};
  for (std::size_t v = 0; v < verticesOf(fronts); ++v)
    for (const HarmonicTransfer* side : {&fronts, &through})
      for (int c = 0; c < both.channels; ++c)
        for (std::size_t i = 0; i < static_cast<std::size_t>(both.order * both.order); ++i)
          both.coefficients.push_back(coefficientOf(*side, v, c, i));
  return both;
}

/// Sides are 2 where a bake knows what arrives on the other side of surfaces that let light through.
Json addSeries(const char* name, const HarmonicTransfer& fronts,
               const std::optional<HarmonicTransfer>* through, PageData& data) {
  const bool knowsThrough = through != nullptr && through->has_value();
  const HarmonicTransfer transfer = knowsThrough ? bothSides(fronts, **through) : fronts;
  data.addHalves(name, transfer.coefficients);
  return {{"array", name},
          {"order", transfer.order},
          {"channels", transfer.channels},
          {"sides", knowsThrough ? 2 : 1}};
}

/// Positions and normals of a map's texels, six numbers each.
void addPlaces(const std::string& name, const ChartTransfer::Map& map, const CompiledScene& scene,
               PageData& data) {
  std::vector<float> numbers;
  for (const ChartPlace& place : placesOf(map, scene))
    for (const glm::vec3& part : {place.position, place.normal})
      numbers.insert(numbers.end(), {part.x, part.y, part.z});
  data.addHalves(name, numbers);
}

/// Places of vertices in an atlas of their maps, and the numbers of those; where the texels lie, for lights.
Json addCharts(const RenderInputs& inputs, PageData& data) {
  const ChartTransfer& transfer = *inputs.bake->chartTransfer;
  const CompiledScene& scene = inputs.compiled;
  const ChartAtlas atlas = chartAtlasOf(transfer);
  data.addFloats("chartCoords", std::span<const glm::vec4>(chartCoords(transfer, scene, atlas)));
  Json maps = Json::array();
  for (std::size_t m = 0; m < transfer.maps.size(); ++m) {
    const ChartTransfer::Map& map = transfer.maps[m];
    const std::string array = "charts" + std::to_string(m);
    data.addHalves(array, map.coefficients);
    const ChartAtlas::Place& place = atlas.places[m];
    maps.push_back({{"array", array},
                    {"places", array + "Places"},
                    {"width", map.width},
                    {"height", map.height},
                    {"place", {place.x, place.y, place.layer}},
                    {"bumped", hasBumps(scene, map)}});
    addPlaces(array + "Places", map, scene, data);
  }
  return {{"order", transfer.order}, {"channels", transfer.channels}, {"border", chartBorder},
          {"side", atlas.side},      {"layers", atlas.layers},        {"maps", maps}};
}

/// Shells of distance, once for all shadings that have their shadows.
Json addNearLamps(const NearLampTransfer& transfer, PageData& data) {
  if (!data.arrays().contains("nearLamps")) data.addHalfBits("nearLamps", transfer.halves);
  return {{"array", "nearLamps"},        {"order", transfer.order},       {"shells", transfer.shells},
          {"nearest", transfer.nearest}, {"farthest", transfer.farthest}, {"lag", shellLag}};
}

/// Once, for all shadings that have it.
Json addOpen(const Bake& bake, PageData& data) {
  if (data.arrays().contains("open")) return "open";
  std::vector<float> open;
  for (std::size_t v = 0; v < bake.ao.size(); ++v) {
    const glm::vec3& bent = bake.bentNormals[v];
    open.insert(open.end(), {bent.x, bent.y, bent.z, bake.ao[v]});
  }
  data.addHalves("open", open);
  return "open";
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

/// Lobes a texel of four numbers, divided by what matrices are multiplied with.
template <typename T>
void addLobes(const std::string& name, std::vector<T> lobes, int scaled, PageData& data) {
  const auto scale = static_cast<float>(1.0 / std::sqrt(4.0 * std::numbers::pi));
  for (T& lobe : lobes)
    for (int k = 0; k < scaled; ++k) lobe[k] *= scale;
  data.addFloats(name, std::span<const T>(lobes));
}

}  // namespace

Json pageSh(const RenderInputs& inputs, PageData& data) {
  const Bake& bake = *inputs.bake;
  Json json = addSeries("sh", bake.sh ? *bake.sh : decompress(*bake.compressedSh),
                        bake.through ? &bake.through->sh : nullptr, data);
  if (bake.nearLamps) json["nearLamps"] = addNearLamps(*bake.nearLamps, data);
  if (bake.chartTransfer) json["charts"] = addCharts(inputs, data);
  return json;
}

Json pageCh(const RenderInputs& inputs, PageData& data) {
  const Bake& bake = *inputs.bake;
  Json json = addSeries("ch", *bake.ch, bake.through ? &bake.through->ch : nullptr, data);
  if (bake.nearLamps) json["nearLamps"] = addNearLamps(*bake.nearLamps, data);
  data.addFloats("chBasis", std::span<const float>(chBasisTable(ch::Basis(json["order"].get<int>()))));
  return json;
}

/// The matrices are multiplied by sqrt(4 pi), so that the first number of what arrives is diffuse light;
/// their rows, a channel each, lie as those of a series: [vertex][i][channel][j].
Json pageGlossy(const RenderInputs& inputs, PageData& data) {
  const GlossyTransfer& transfer = *inputs.bake->glossy;
  const auto length = static_cast<std::size_t>(transfer.order * transfer.order),
             channels = static_cast<std::size_t>(transfer.channels);
  const auto scale = static_cast<float>(std::sqrt(4.0 * std::numbers::pi));
  std::vector<float> rows;
  rows.reserve(transfer.matrices.size());
  for (std::size_t vertex = 0; vertex * channels * length * length < transfer.matrices.size(); ++vertex)
    for (std::size_t i = 0; i < length; ++i)
      for (std::size_t c = 0; c < channels; ++c)
        for (std::size_t j = 0; j < length; ++j)
          rows.push_back(scale * transfer.matrices[((vertex * channels + c) * length + i) * length + j]);
  data.addHalves("glossy", rows);
  data.addHalves("glossyOpen", glossyAccessibility(transfer));
  addLobes("lobes", makeLobeTable(Lobe::Ggx, transfer.order).texels(), 1, data);
  addLobes("measuredLobes", measuredLobes(inputs.compiled, transfer.order), 3, data);
  Json json = {{"array", "glossy"}, {"order", transfer.order}, {"channels", transfer.channels}};
  if (inputs.bake->nearLamps) json["nearLamps"] = addNearLamps(*inputs.bake->nearLamps, data);
  return json;
}

Json pageHaar(const RenderInputs& inputs, PageData& data) {
  const auto add = [&](const char* name, const HaarTransfer& transfer) -> Json {
    const std::string prefix = name;
    data.addWholes(prefix + "Offsets", transfer.offsets);
    if (transfer.storedIndexBytes() == 2)
      data.addShorts(prefix + "Indices",
                     std::vector<std::uint16_t>(transfer.indices.begin(), transfer.indices.end()));
    else
      data.addWholes(prefix + "Indices", transfer.indices);
    data.addHalves(prefix + "Values", transfer.values);
    return {{"prefix", prefix}, {"faceSize", transfer.faceSize}, {"channels", transfer.channels}};
  };
  const Bake& bake = *inputs.bake;
  Json json = {{"sides", Json::array({add("haar", *bake.haar)})}};
  if (bake.through && bake.through->haar) json["sides"].push_back(add("haarThrough", *bake.through->haar));
  if (bake.nearLamps) json["nearLamps"] = addNearLamps(*bake.nearLamps, data);
  return json;
}

Json pageLightGroups(const RenderInputs& inputs, PageData& data) {
  const LightGroupTransfer& transfer = *inputs.bake->lightGroups;
  Json groups = Json::array();
  for (const LightGroup& group : transfer.groups)
    groups.push_back({{"name", group.name}, {"color", numbersOf(group.color)}});
  data.addHalves("groups", transfer.coefficients);
  std::vector<float> glow;
  for (const int group : glowGroups(transfer, inputs.compiled)) glow.push_back(static_cast<float>(group));
  if (std::any_of(glow.begin(), glow.end(), [](float group) { return group >= 0.0f; }))
    data.addHalves("glowGroups", glow);
  return {{"array", "groups"}, {"groups", groups}, {"channels", transfer.channels}};
}

/// Irradiance, and where the map has them coefficients of where it comes from.
Json pageLightMap(const RenderInputs& inputs, PageData& data) {
  const LightMap& map = *inputs.bake->lightMap;
  if (map.coefficients == 1) {
    data.addColors("lightMap", irradianceOf(map).pixels);
  } else {
    std::vector<float> layers;
    const auto length = static_cast<std::size_t>(map.coefficients);
    for (std::size_t i = 0; i < length; ++i)
      for (std::size_t texel = 0; 3 * length * texel < map.values.size(); ++texel)
        for (std::size_t c = 0; c < 3; ++c) layers.push_back(map.values[(3 * texel + c) * length + i]);
    data.addHalves("lightMap", layers);
  }
  data.addFloats("lightMapCorners", std::span<const glm::vec2>(lightMapCorners(map.layout)));
  const std::vector<glm::vec2> walls = lightMapWalls(map.layout, map.layout.width);
  if (!walls.empty()) data.addFloats("lightMapWalls", std::span<const glm::vec2>(walls));
  return {{"width", map.layout.width},
          {"height", map.layout.height},
          {"layers", map.coefficients},
          {"walled", !walls.empty()}};
}

Json pageRadiosity(const RenderInputs& inputs, PageData& data) {
  std::vector<float> radiance;
  for (const glm::vec3& e : *inputs.bake->irradiance)
    for (int c = 0; c < 3; ++c) radiance.push_back(e[c] * std::numbers::inv_pi_v<float>);
  data.addHalves("radiosity", radiance);
  return {{"array", "radiosity"}};
}

Json pageAo(const RenderInputs& inputs, PageData& data) {
  const Bake& bake = *inputs.bake;
  Json json = {{"array", addOpen(bake, data)}};
  if (!bake.through || bake.through->ao.empty()) return json;
  data.addHalves("openBeyond", bake.through->ao);
  json["beyond"] = "openBeyond";
  return json;
}

Json pageCones(const RenderInputs& inputs, PageData& data) {
  const Bake& bake = *inputs.bake;
  data.addHalves("apertures", bake.apertures);
  return {{"array", addOpen(bake, data)}, {"apertures", "apertures"}};
}

/// Places and distances as floats, the rest of a record as halves.
Json pageOccluders(const RenderInputs& inputs, PageData& data) {
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

}  // namespace prelight::viewer
