#include "integrators/cached_light.h"

#include <algorithm>

namespace prelight::reference {

namespace {

constexpr std::uint32_t causticSamples = 2;  // of a pixel

}  // namespace

BuildOptions cachedLightOptions(const CachedLight& light, BuildOptions options) {
  if (light.caustics == nullptr) return options;
  return DensityEstimator::addOptions(options.define("PRELIGHT_CACHED_CAUSTICS"),
                                      light.caustics->filter.density);
}

cl::Kernel followPathsKernel(const cl::Program& program, const TransportScene& scene,
                             const CompiledScene& compiled, const CachedLight& light, std::uint32_t samples) {
  cl::Kernel kernel(program, "followPaths");
  const cl_uint index = light.indirect->setArguments(kernel, scene.setArguments(kernel, firstOfScene));
  kernel.setArg(index, static_cast<cl_uint>(light.indirect->width()));
  kernel.setArg(index + 1, static_cast<cl_uint>(light.indirect->height()));
  kernel.setArg(index + 2, static_cast<cl_uint>(compiled.triangleCount()));
  if (light.caustics == nullptr) return kernel;
  light.caustics->estimator.setArguments(kernel, index + 3);
  kernel.setArg(index + 11, static_cast<cl_float>(light.caustics->filter.radius));
  kernel.setArg(index + 12, static_cast<cl_uint>(samples));
  kernel.setArg(index + 13, static_cast<cl_uint>(std::min(samples, causticSamples)));
  return kernel;
}

}  // namespace prelight::reference
