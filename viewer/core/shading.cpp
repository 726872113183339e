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

float expectedError(Shading shading, const LightOfPicture& light) {
  const ShadingInfo& info = infoOf(shading);
  if (info.traits.bakedLight && !light.asBaked) return 1.0f;
  float error = light.sky || (!light.outside && !light.inside) ? info.error.sky : 0.0f;
  if (light.outside) error = std::max(error, info.error.outside);
  return light.inside ? std::max(error, info.error.inside) : error;
}

namespace {

constexpr float usualAlbedo = 0.5f;

/// Returns the relMSE of pictures that lack bounces, which grows with how closed the scene is: surfaces that
/// hide a share of each other's sky send on that share of the light times their albedo, again and again.
float errorWithoutBounces(const Bake& bake) {
  for (const ShadingInfo& info : shadings()) {
    if (info.openness == nullptr || !info.carriedBy(bake)) continue;
    const float lost = usualAlbedo * static_cast<float>(1.0 - info.openness(bake));
    return lost * lost;
  }
  return 0.0f;
}

bool showsBounces(const ShadingInfo& info, const Bake& bake) {
  return info.traits.bakedLight || (info.traits.bounces && bake.info.bounces > 0);
}

}  // namespace

Shading carriedShading(const Bake& bake, const LightOfPicture& light) {
  const float withoutBounces = errorWithoutBounces(bake);
  Shading best = Shading::Phong;
  float least = std::numeric_limits<float>::infinity();
  for (const Shading shading : shadingsByPreference()) {
    const ShadingInfo& info = infoOf(shading);
    float error = expectedError(shading, light);
    if (!showsBounces(info, bake)) error = std::max(error, withoutBounces);
    if (info.bakeOption.empty() || !info.carriedBy(bake) || error >= least) continue;
    best = shading;
    least = error;
  }
  return best;
}

}  // namespace prelight::viewer
