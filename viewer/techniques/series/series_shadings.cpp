#include <memory>

#include "techniques/ch/ch.h"
#include "techniques/light_groups/light_groups.h"
#include "techniques/sh/sh.h"
#include "viewer/programs/drawn_shading.h"
#include "viewer/techniques/series/chart_lighting.h"
#include "viewer/techniques/series/cluster_transfer.h"
#include "viewer/techniques/series/series_transfer.h"
#include "viewer/techniques/through/through_lighting.h"

namespace prelight::viewer {
namespace {

/// Adds transfer of surfaces' other sides in a basis, where the bake has it.
std::unique_ptr<DrawnTransfer> withThrough(std::unique_ptr<DrawnTransfer> fronts,
                                           const std::optional<HarmonicTransfer>& known,
                                           HarmonicSeries::Basis basis, const CompiledScene& scene) {
  if (!known) return fronts;
  return std::make_unique<ThroughLighting>(
      std::move(fronts), std::make_unique<HarmonicSeries>(*known, basis, scene, Attribute::Through));
}

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

std::unique_ptr<DrawnTransfer> makeSh(const TechniqueInputs& of) {
  const RenderInputs& inputs = of.inputs;
  std::unique_ptr<DrawnTransfer> vertices = makeShOfVertices(inputs);
  if (inputs.bake->through)
    vertices = withThrough(std::move(vertices), inputs.bake->through->sh, HarmonicSeries::Basis::Sh,
                           inputs.compiled);
  if (!inputs.bake->chartTransfer) return vertices;
  return std::make_unique<ChartLighting>(*inputs.bake->chartTransfer, inputs.compiled, std::move(vertices));
}

std::unique_ptr<DrawnTransfer> makeCh(const TechniqueInputs& of) {
  constexpr auto basis = HarmonicSeries::Basis::Ch;
  std::unique_ptr<DrawnTransfer> fronts =
      std::make_unique<HarmonicSeries>(*of.inputs.bake->ch, basis, of.inputs.compiled);
  if (!of.inputs.bake->through) return fronts;
  return withThrough(std::move(fronts), of.inputs.bake->through->ch, basis, of.inputs.compiled);
}

std::unique_ptr<DrawnTransfer> makeLights(const TechniqueInputs& of) {
  const LightGroupTransfer& transfer = *of.inputs.bake->lightGroups;
  return std::make_unique<GroupSeries>(transfer, glowGroups(transfer, of.inputs.compiled),
                                       of.inputs.compiled);
}

}  // namespace

extern const DrawnShading drawnSh = {.info = &shShading, .make = makeSh};
extern const DrawnShading drawnCh = {.info = &chShading, .make = makeCh};
extern const DrawnShading drawnLights = {.info = &lightsShading, .make = makeLights};

}  // namespace prelight::viewer
