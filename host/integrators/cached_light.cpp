#include "integrators/cached_light.h"

#include <algorithm>

namespace prelight::reference {

namespace {

constexpr std::uint32_t causticSamples = 2;  // per pixel

}  // namespace

BuildOptions cachedLightOptions(const CachedLight& light, BuildOptions options) {
  if (light.caustics == nullptr) return options;
  return DensityEstimator::addOptions(options.define("PRELIGHT_CACHED_CAUSTICS"),
                                      light.caustics->filter.density);
}

void setCachedLight(const CachedLight& light, std::uint32_t samples,
                    device::CachedPathParameters& parameters) {
  parameters.indirect = light.indirect->layout();
  if (light.caustics == nullptr) return;
  parameters.caustics = light.caustics->estimator.parameters();
  parameters.causticRadius = static_cast<float>(light.caustics->filter.radius);
  parameters.causticSamples = std::min(samples, causticSamples);
}

}  // namespace prelight::reference
