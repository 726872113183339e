#include "techniques/bake_fit.h"
#include "techniques/shading.h"

namespace prelight {
namespace {

void checkOtherSides(const Bake& bake, const CompiledScene& scene) {
  const auto& through = bake.through;
  if (!through) return;
  if (!through->ao.empty()) requireCount("AO of other sides", through->ao.size(), scene.vertexCount());
  if (through->sh) requireHarmonics("SH transfer of other sides", *through->sh, scene);
  if (through->ch) requireHarmonics("CH transfer of other sides", *through->ch, scene);
  if (through->haar)
    requireCount("Haar transfer of other sides", through->haar->offsets.size(),
                 rowNumbers(scene.vertexCount(), through->haar->channels, 1, 0) + 1);
}

void takeOtherSides(Bake& into, Bake& from) {
  if (!from.through) return;
  if (!into.through) into.through.emplace();
  if (!from.through->ao.empty()) into.through->ao = std::move(from.through->ao);
  takePart(into.through->sh, from.through->sh);
  takePart(into.through->ch, from.through->ch);
  takePart(into.through->haar, from.through->haar);
}

}  // namespace

/// Light on the other side of surfaces, which pictures show with any transfer.
extern const BakedPart otherSidesPart = {.check = checkOtherSides, .take = takeOtherSides};

}  // namespace prelight
