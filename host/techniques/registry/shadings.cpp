#include "techniques/registry/shadings.h"

#include <array>

namespace prelight {

/// Parts in the folders of techniques that have no shading.
extern const BakedPart chartPart, encodingPart, otherSidesPart, shellPart;

namespace {

constexpr std::array bakedShadings = {&aoShading,       &conesShading,    &horizonsShading, &shShading,
                                      &chShading,       &haarShading,     &glossyShading,   &lightsShading,
                                      &occluderShading, &lightMapShading, &radiosityShading};
constexpr std::array parts = {&chartPart, &encodingPart, &otherSidesPart, &shellPart};

}  // namespace

void checkBake(const Bake& bake, const CompiledScene& scene) {
  for (const ShadingInfo* shading : bakedShadings) shading->check(bake, scene);
  for (const BakedPart* part : parts) part->check(bake, scene);
}

void takeBake(Bake& into, Bake&& from) {
  for (const ShadingInfo* shading : bakedShadings) shading->take(into, from);
  for (const BakedPart* part : parts) part->take(into, from);
}

void addParts(BakeRequest& request, const BakeRequest& asked) {
  for (const BakedPart* part : parts) part->addTo(request, asked);
}

}  // namespace prelight
