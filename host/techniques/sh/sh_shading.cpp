#include "techniques/bake_fit.h"
#include "techniques/shading.h"

namespace prelight {
namespace {

constexpr int defaultOrderOfSh = 3;

void checkSh(const Bake& bake, const CompiledScene& scene) {
  if (bake.sh) requireHarmonics("SH transfer", *bake.sh, scene);
  if (const auto& compressed = bake.compressedSh) {
    requireDrawable("compressed SH transfer", compressed->order, maxTransferOrder, compressed->channels);
    requireCount("compressed SH transfer", compressed->vertexCount, scene.vertexCount());
  }
}

VertexRows shRows(const Bake& bake) {
  if (!bake.sh) return {};
  return {bake.sh->coefficients, static_cast<std::size_t>(bake.sh->order * bake.sh->order) *
                                     static_cast<std::size_t>(bake.sh->channels)};
}

}  // namespace

extern const ShadingInfo shShading = {
    .shading = Shading::Sh,
    .summary = "light through spherical-harmonic transfer",
    .bakeOption = "sh 3",
    .bakedName = "SH transfer",
    .rules = throughTransfer,
    .traits = {.bounces = true,
               .bakedForWindows = true,
               .skyLampsApart = true,
               .followsAnimation = true,
               .objectsInCubes = true},
    .error = {.sky = 0.02f, .outside = 0.08f, .inside = 0.06f},
    .carriedBy = [](const Bake& bake) { return bake.sh.has_value() || bake.compressedSh.has_value(); },
    .askedBy = [](const BakeRequest& request) { return request.sh.order > 0; },
    .addTo =
        [](BakeRequest& request, const BakeRequest& asked) {
          request.sh = asked.sh;
          request.sh.order = orDefault(asked.sh.order, defaultOrderOfSh);
        },
    .check = checkSh,
    .take =
        [](Bake& into, Bake& from) {
          if (!shShading.carriedBy(from)) return;  // else both: one stands in place of the other
          into.sh = std::exchange(from.sh, std::nullopt);
          into.compressedSh = std::exchange(from.compressedSh, std::nullopt);
        },
    .changingRows = shRows,
};

}  // namespace prelight
