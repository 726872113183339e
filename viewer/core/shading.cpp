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

Shading carriedShading(const Bake& bake, const LightOfPicture& light) {
  Shading best = Shading::Phong;
  float least = std::numeric_limits<float>::infinity();
  for (const Shading shading : shadingsByPreference()) {
    const ShadingInfo& info = infoOf(shading);
    const float error = expectedError(shading, light);
    if (info.bakeOption.empty() || !info.carriedBy(bake) || error >= least) continue;
    best = shading;
    least = error;
  }
  return best;
}

}  // namespace prelight::viewer
