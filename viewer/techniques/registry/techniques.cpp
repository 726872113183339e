#include "viewer/techniques/registry/techniques.h"

#include <array>
#include <string>

#include "base/text.h"
#include "gi/global_illumination.h"
#include "occluders/occluder_record.h"
#include "prelight/error.h"
#include "viewer/techniques/ambient_occlusion/ao_attributes.h"
#include "viewer/techniques/encoded_light/encoded_lighting.h"
#include "viewer/techniques/glossy/glossy_lighting.h"
#include "viewer/techniques/haar/haar_lighting.h"
#include "viewer/techniques/horizons/horizon_lighting.h"
#include "viewer/techniques/light_map/light_map_lighting.h"
#include "viewer/techniques/radiosity/static_light.h"
#include "viewer/techniques/series/chart_lighting.h"
#include "viewer/techniques/series/cluster_transfer.h"
#include "viewer/techniques/series/series_transfer.h"
#include "viewer/techniques/through/through_lighting.h"
#include "viewer/techniques/vector_occluders/occluder_lighting.h"

namespace prelight::viewer {
namespace {

/// `fronts`, with what comes through surfaces where the bake knows it: make(it) draws that.
template <typename Known, typename Make>
std::unique_ptr<DrawnTransfer> withThrough(std::unique_ptr<DrawnTransfer> fronts, const Known& known,
                                           const Make& make) {
  if (!known) return fronts;
  return std::make_unique<ThroughLighting>(std::move(fronts), make(*known));
}

std::unique_ptr<DrawnTransfer> makeAo(const RenderInputs& inputs, Lobe) {
  std::unique_ptr<DrawnTransfer> fronts = std::make_unique<AoAttributes>(*inputs.bake);
  const auto& through = inputs.bake->through;
  if (!through || through->ao.empty()) return fronts;
  return std::make_unique<ThroughLighting>(std::move(fronts), std::make_unique<ThroughAo>(through->ao));
}

/// Adds transfer of surfaces' other sides in a basis, where the bake has it.
std::unique_ptr<DrawnTransfer> withThroughSeries(std::unique_ptr<DrawnTransfer> fronts,
                                                 const std::optional<HarmonicTransfer>& known,
                                                 HarmonicSeries::Basis basis, const CompiledScene& scene) {
  return withThrough(std::move(fronts), known, [&](const HarmonicTransfer& transfer) {
    return std::make_unique<HarmonicSeries>(transfer, basis, scene, Attribute::Through);
  });
}

using Maker = std::unique_ptr<DrawnTransfer> (*)(const RenderInputs&, Lobe);

std::unique_ptr<DrawnTransfer> makeShOfVertices(const RenderInputs& inputs) {
  if (inputs.bake->sh)
    return std::make_unique<HarmonicSeries>(*inputs.bake->sh, HarmonicSeries::Basis::Sh, inputs.compiled);
  const CompressedTransfer& compressed = *inputs.bake->compressedSh;
  if (compressed.method == CompressionMethod::Rgbe)  // no shader decodes it
    return std::make_unique<HarmonicSeries>(decompress(compressed), HarmonicSeries::Basis::Sh,
                                            inputs.compiled);
  if (compressed.method == CompressionMethod::Half || compressed.method == CompressionMethod::Band8)
    return std::make_unique<HarmonicSeries>(compressed, inputs.compiled);
  return std::make_unique<ClusterTransfer>(compressed, inputs.compiled);
}

std::unique_ptr<DrawnTransfer> makeSh(const RenderInputs& inputs, Lobe) {
  std::unique_ptr<DrawnTransfer> vertices = makeShOfVertices(inputs);
  if (inputs.bake->through)
    vertices = withThroughSeries(std::move(vertices), inputs.bake->through->sh, HarmonicSeries::Basis::Sh,
                                 inputs.compiled);
  if (!inputs.bake->chartTransfer) return vertices;
  return std::make_unique<ChartLighting>(*inputs.bake->chartTransfer, inputs.compiled, std::move(vertices));
}

/// Draws the encoding of a bake that holds it (drawsEncoding).
std::unique_ptr<DrawnTransfer> makeEncoded(Shading shading, const RenderInputs& inputs) {
  const std::string_view name = inputs.encoding->name;
  const Bake& bake = *inputs.bake;
  if (shading == Shading::Radiosity)
    return std::make_unique<EncodedVertexLighting>(*findEncoded(bake.encodedLight, name));
  const LightMap& map = *bake.lightMap;
  return std::make_unique<LightMapLighting>(layersOf(map, *findEncoded(map.encoded, name)), inputs.compiled);
}

std::unique_ptr<DrawnTransfer> makeCh(const RenderInputs& inputs, Lobe) {
  constexpr auto basis = HarmonicSeries::Basis::Ch;
  std::unique_ptr<DrawnTransfer> fronts =
      std::make_unique<HarmonicSeries>(*inputs.bake->ch, basis, inputs.compiled);
  if (!inputs.bake->through) return fronts;
  return withThroughSeries(std::move(fronts), inputs.bake->through->ch, basis, inputs.compiled);
}

std::unique_ptr<DrawnTransfer> makeHaar(const RenderInputs& inputs, Lobe) {
  std::unique_ptr<DrawnTransfer> fronts = std::make_unique<HaarLighting>(*inputs.bake->haar, inputs.device);
  if (!inputs.bake->through) return fronts;
  return withThrough(std::move(fronts), inputs.bake->through->haar, [&](const HaarTransfer& transfer) {
    return std::make_unique<HaarLighting>(transfer, inputs.device, Attribute::Through);
  });
}

std::unique_ptr<DrawnTransfer> nothingBaked(const RenderInputs&, Lobe) { return nullptr; }

struct Technique {
  Shading shading = Shading::Phong;
  DrawingRules rules;
  Maker make = nullptr;
};

constexpr DrawingRules throughTransfer = {Ambient::Transferred, Reflection::Metals, Through::FarLights};

/// How each shading is drawn.
constexpr std::array<Technique, shadingCount> techniqueTable = {{
    {Shading::Phong, {}, nothingBaked},
    {Shading::Ao, {Ambient::Accessible, Reflection::Everywhere, Through::None}, makeAo},
    {Shading::Sh, throughTransfer, makeSh},
    {Shading::Ch, throughTransfer, makeCh},
    {Shading::Haar, throughTransfer, makeHaar},
    {Shading::Glossy,
     {Ambient::Transferred, Reflection::Transfer, Through::FarLights},
     [](const RenderInputs& inputs, Lobe lobe) -> std::unique_ptr<DrawnTransfer> {
       return std::make_unique<GlossyLighting>(*inputs.bake->glossy, inputs.compiled, lobe, inputs.device);
     }},
    {Shading::Lights,
     {Ambient::Transferred, Reflection::Metals, Through::AllLights},
     [](const RenderInputs& inputs, Lobe) -> std::unique_ptr<DrawnTransfer> {
       const LightGroupTransfer& transfer = *inputs.bake->lightGroups;
       return std::make_unique<GroupSeries>(transfer, glowGroups(transfer, inputs.compiled), inputs.compiled);
     }},
    {Shading::Vo,
     {Ambient::Transferred, Reflection::Metals, Through::AllLights},
     [](const RenderInputs& inputs, Lobe) -> std::unique_ptr<DrawnTransfer> {
       return std::make_unique<OccluderLighting>(inputs);
     }},
    {Shading::Radiosity,
     {Ambient::Transferred, Reflection::Metals, Through::AllLights},
     [](const RenderInputs& inputs, Lobe) -> std::unique_ptr<DrawnTransfer> {
       return std::make_unique<StaticLight>(*inputs.bake->irradiance);
     }},
    {Shading::LightMap,
     {Ambient::LightMap, Reflection::Metals, Through::AllLights},
     [](const RenderInputs& inputs, Lobe) -> std::unique_ptr<DrawnTransfer> {
       return std::make_unique<LightMapLighting>(*inputs.bake->lightMap, inputs.compiled);
     }},
    {Shading::Cones,
     {Ambient::Cone, Reflection::Everywhere, Through::None},
     [](const RenderInputs& inputs, Lobe) -> std::unique_ptr<DrawnTransfer> {
       return std::make_unique<AoAttributes>(*inputs.bake);
     }},
    {Shading::GlobalIllumination, {Ambient::LightMap, Reflection::Everywhere, Through::None}, nothingBaked},
    {Shading::Screen, {Ambient::Screen, Reflection::Everywhere, Through::None}, nothingBaked},
    {Shading::Horizons,
     {Ambient::Horizons, Reflection::Everywhere, Through::None},
     [](const RenderInputs& inputs, Lobe) -> std::unique_ptr<DrawnTransfer> {
       return std::make_unique<HorizonLighting>(*inputs.bake->horizons, inputs.compiled);
     }},
    {Shading::Instant, {Ambient::VirtualLights, Reflection::Everywhere, Through::None}, nothingBaked},
}};
static_assert(followsOrder(techniqueTable, &Technique::shading));

void expectSize(const char* what, std::size_t got, std::size_t expected) {
  if (got == expected) return;
  throw Error(ExitCode::RuntimeFailure, what,
              "the bake has " + std::to_string(got) + " values, this scene needs " + std::to_string(expected),
              "bake this scene again");
}

void expectDrawable(const char* what, int order, int most, int channels) {
  if (order >= 1 && order <= most && (channels == 1 || channels == 3)) return;
  throw Error(ExitCode::RuntimeFailure, what,
              "order " + std::to_string(order) + " in " + std::to_string(channels) +
                  " channels; orders 1 to " + std::to_string(most) + " in 1 or 3 channels can be drawn");
}

std::size_t numbers(std::uint32_t vertices, int channels, int order, int power) {
  std::size_t count = std::size_t{vertices} * static_cast<std::size_t>(channels);
  for (int i = 0; i < power; ++i) count *= static_cast<std::size_t>(order);
  return count;
}

void checkHarmonics(const char* what, const HarmonicTransfer& transfer, std::uint32_t vertices) {
  expectDrawable(what, transfer.order, maxTransferOrder, transfer.channels);
  expectSize(what, transfer.coefficients.size(), numbers(vertices, transfer.channels, transfer.order, 2));
}

void checkThrough(const ThroughTransfer& through, std::uint32_t vertices) {
  if (!through.ao.empty()) expectSize("AO of other sides", through.ao.size(), vertices);
  if (through.sh) checkHarmonics("SH transfer of other sides", *through.sh, vertices);
  if (through.ch) checkHarmonics("CH transfer of other sides", *through.ch, vertices);
  if (through.haar)
    expectSize("Haar transfer of other sides", through.haar->offsets.size(),
               numbers(vertices, through.haar->channels, 1, 0) + 1);
}

void checkOccluders(const OccluderTransfer& occluders, std::uint32_t vertices) {
  expectSize("vector occluders", occluders.offsets.size(), std::size_t{vertices} + 1);
  expectSize("vector occluders", occluders.vectors.size(), occluders.recordCount() * occluders.stored.size());
  for (const OccluderVector needed : {OccluderVector::Position, OccluderVector::Occlusion,
                                      OccluderVector::DiffuseNormal, OccluderVector::DiffuseColor})
    if (placeOf(occluders, needed) == occluders.stored.size())
      throw Error(ExitCode::RuntimeFailure, "vector occluders",
                  "the bake has no " + std::string(occluderVectorNames[static_cast<std::size_t>(needed)]),
                  "bake this scene again");
}

void checkCharts(const ChartTransfer& texels, const CompiledScene& scene) {
  expectDrawable("light maps", texels.order, maxTransferOrder, texels.channels);
  for (const ChartTransfer::Map& map : texels.maps) {
    expectSize("primitives with light maps", map.primitive < scene.primitives.size() ? 1 : 0, 1);
    expectSize("texture coordinates of light maps", map.coords.size(),
               scene.primitives[map.primitive].vertexCount);
    expectSize(
        "light maps", map.coefficients.size(),
        static_cast<std::size_t>(map.width) * static_cast<std::size_t>(map.height) * texels.rowLength());
  }
}

/// Light in encodings, at as many places.
void checkEncoded(const char* what, const std::vector<EncodedLight>& lights, std::size_t places) {
  for (const EncodedLight& light : lights)
    if (const Encoding* encoding = encodingNamed(light.encoding))
      expectSize(what, light.values.size(), places * encoding->values);
}

void checkLightMap(const LightMap& map, const CompiledScene& scene) {
  checkEncoded("encoded light of texels", map.encoded, map.layout.texelCount());
  expectSize("faces of the light map", map.layout.chartOf.size(), 2 * std::size_t{scene.triangleCount()});
  expectSize("light map", map.values.size(),
             3 * map.layout.texelCount() * static_cast<std::size_t>(map.coefficients));
}

}  // namespace

bool drawsEncoding(Shading shading, const RenderInputs& inputs) {
  if (inputs.encoding == nullptr || inputs.bake == nullptr) return false;
  const Bake& bake = *inputs.bake;
  if (shading == Shading::LightMap && bake.lightMap)
    return findEncoded(bake.lightMap->encoded, inputs.encoding->name) != nullptr;
  return shading == Shading::Radiosity && findEncoded(bake.encodedLight, inputs.encoding->name) != nullptr;
}

DrawingRules rulesOf(Shading shading, const RenderInputs& inputs) {
  DrawingRules rules = techniqueTable[static_cast<std::size_t>(shading)].rules;
  if (drawsEncoding(shading, inputs))
    rules.ambient = shading == Shading::LightMap ? Ambient::EncodedMap : Ambient::EncodedVertices;
  return rules;
}

bool lightsByCubes(Shading shading, const RenderInputs& inputs) {
  return !inputs.cubeLit.empty() &&
         (shading == Shading::Phong || shading == Shading::Sh || shading == Shading::Lights);
}

DrawingRules rulesOfObjects(DrawingRules scene) {
  scene.ambient = Ambient::ObjectCube;
  if (scene.through == Through::FarLights) scene.through = Through::None;
  return scene;
}

void checkBake(const Bake& bake, const CompiledScene& scene) {
  const std::uint32_t vertices = scene.vertexCount();
  if (!bake.ao.empty()) expectSize("ambient occlusion", bake.ao.size(), vertices);
  if (bake.irradiance) expectSize("irradiance", bake.irradiance->size(), vertices);
  if (!bake.bentNormals.empty()) expectSize("bent normals", bake.bentNormals.size(), vertices);
  if (!bake.apertures.empty()) expectSize("occlusion cones", bake.apertures.size(), vertices);
  if (bake.horizons)
    expectSize("horizons", bake.horizons->angles.size(), numbers(vertices, bake.horizons->sectors, 1, 0));
  if (bake.horizons && !bake.horizons->feet.empty())
    expectSize("feet of horizons", bake.horizons->feet.size(),
               numbers(vertices, bake.horizons->sectors, 1, 0));
  if (bake.sh) checkHarmonics("SH transfer", *bake.sh, vertices);
  if (const auto& lamps = bake.nearLamps) {
    expectDrawable("shells of near lamps", lamps->order, maxTransferOrder, 1);
    expectSize("shells of near lamps", lamps->halves.size(),
               numbers(vertices, lamps->shells, lamps->order, 2));
  }
  if (bake.ch) checkHarmonics("CH transfer", *bake.ch, vertices);
  if (bake.through) checkThrough(*bake.through, vertices);
  if (const auto& compressed = bake.compressedSh) {
    expectDrawable("compressed SH transfer", compressed->order, maxTransferOrder, compressed->channels);
    expectSize("compressed SH transfer", compressed->vertexCount, vertices);
  }
  if (const auto& haar = bake.haar) {
    expectSize("Haar transfer", haar->offsets.size(), numbers(vertices, haar->channels, 1, 0) + 1);
  }
  if (const auto& glossy = bake.glossy) {
    expectDrawable("glossy transfer", glossy->order, maxGlossyOrder, glossy->channels);
    expectSize("glossy transfer", glossy->matrices.size(),
               numbers(vertices, glossy->channels, glossy->order, 4));
  }
  if (bake.occluders) checkOccluders(*bake.occluders, vertices);
  if (bake.chartTransfer) checkCharts(*bake.chartTransfer, scene);
  if (bake.lightMap) checkLightMap(*bake.lightMap, scene);
  checkEncoded("encoded light of vertices", bake.encodedLight, vertices);
  if (const auto& lights = bake.lightGroups) {
    const auto groups = static_cast<int>(lights->groups.size());
    expectSize("light groups", lights->coefficients.size(), numbers(vertices, lights->channels, groups, 1));
  }
}

void checkGlobalIllumination(const GlobalIllumination& globalIllumination, const CompiledScene& scene) {
  checkLightMap(globalIllumination.indirect, scene);
  for (const device::Photon& photon : globalIllumination.photons)
    if (photon.triangle >= scene.triangleCount())
      throw Error(ExitCode::RuntimeFailure, "photons of caustics", "they belong to another scene");
}

std::unique_ptr<DrawnTransfer> makeDrawnTransfer(Shading shading, const RenderInputs& inputs, Lobe lobe) {
  if (drawsEncoding(shading, inputs)) return makeEncoded(shading, inputs);
  return techniqueTable[static_cast<std::size_t>(shading)].make(inputs, lobe);
}

}  // namespace prelight::viewer
