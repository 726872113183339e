#include "viewer/core/shading.h"

#include <algorithm>
#include <limits>
#include <vector>

#include "base/text.h"
#include "prelight/error.h"

namespace prelight::viewer {

const ShadingInfo& infoOf(Shading shading) { return shadings()[static_cast<std::size_t>(shading)]; }

std::string shadingNames() {
  std::string names;
  for (const ShadingInfo& info : shadings()) names += (names.empty() ? "" : ", ") + std::string(info.name());
  return names;
}

Shading parseShading(std::string_view name) {
  std::vector<std::string> names;
  for (const ShadingInfo& info : shadings()) {
    if (info.name() == name) return info.shading;
    names.emplace_back(info.name());
  }
  throw UsageError("--shading " + std::string(name), "unknown shading",
                   didYouMean(name, names) + "one of: " + shadingNames());
}

namespace {

constexpr float usualAlbedo = 0.5f;

/// The relMSE that pictures of a shading are expected to have in a light, apart from bounces.
float expectedError(const ShadingInfo& info, const LightOfPicture& light) {
  if (info.traits.bakedLight && !light.asBaked) return 1.0f;
  float error = light.sky || (!light.outside && !light.inside) ? info.error.sky : 0.0f;
  if (light.outside) error = std::max(error, info.error.outside);
  return light.inside ? std::max(error, info.error.inside) : error;
}

bool shinesOnlyInside(const LightOfPicture& light) { return light.inside && !light.sky && !light.outside; }

/// Returns the mean share of their sky that vertices see. A scene that lamps inside alone light is taken for
/// closed where its bake does not tell, any other for open.
float opennessOf(const Bake& bake, const LightOfPicture& light) {
  for (const ShadingInfo& info : shadings())
    if (info.openness != nullptr && info.carriedBy(bake)) return static_cast<float>(info.openness(bake));
  return shinesOnlyInside(light) ? 0.0f : 1.0f;
}

/// Returns the relMSE of pictures that lack bounces, which grows with how closed the scene is: surfaces that
/// hide a share of each other's sky send on that share of the light times their albedo, again and again.
float errorWithoutBounces(float openness) {
  const float lost = usualAlbedo * (1.0f - openness);
  return lost * lost;
}

/// Bounces of transfer are those of light from afar alone.
bool showsBounces(const ShadingInfo& info, const Bake& bake, const LightOfPicture& light) {
  return info.traits.bakedLight || (info.traits.bounces && bake.info.bounces > 0 &&
                                    (info.traits.bouncesOfLamps || !shinesOnlyInside(light)));
}

}  // namespace

CarriedShading carriedShading(const Bake& bake, const LightOfPicture& light) {
  const float withoutBounces = errorWithoutBounces(opennessOf(bake, light));
  CarriedShading best{.error = std::numeric_limits<float>::infinity()};
  for (const Shading shading : shadingsByPreference()) {
    const ShadingInfo& info = infoOf(shading);
    if (info.bakeOption.empty() || !info.carriedBy(bake)) continue;
    float error = expectedError(info, light);
    if (!showsBounces(info, bake, light)) error = std::max(error, withoutBounces);
    if (error < best.error) best = {shading, error};
  }
  return best;
}

}  // namespace prelight::viewer
