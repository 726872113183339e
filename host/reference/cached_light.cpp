#include "reference/cached_light.h"

#include <algorithm>

namespace prelight::reference {

namespace {

constexpr std::size_t groupSize = 64;
constexpr std::uint32_t causticSamples = 2;  // of a pixel

BuildOptions optionsOf(const TransportScene& scene, const CachedLight& light) {
  BuildOptions options = scene.options();
  if (light.caustics == nullptr) return options;
  return DensityEstimator::addOptions(options.define("PRELIGHT_CACHED_CAUSTICS"),
                                      light.caustics->filter.density);
}

}  // namespace

CachedLightAdder::CachedLightAdder(TransportScene& scene, const CompiledScene& compiled,
                                   const CachedLight& light, std::uint32_t samples)
    : scene_(scene),
      add_(scene.context().program("reference/cached_light_kernels.cl", optionsOf(scene, light)),
           "addCachedLight") {
  const cl_uint index = light.indirect->setArguments(add_, scene.surface().setArguments(add_, 5));
  add_.setArg(index, static_cast<cl_uint>(light.indirect->width()));
  add_.setArg(index + 1, static_cast<cl_uint>(light.indirect->height()));
  add_.setArg(index + 2, static_cast<cl_uint>(compiled.triangleCount()));
  if (light.caustics == nullptr) return;
  light.caustics->estimator.setArguments(add_, index + 3);
  add_.setArg(index + 11, static_cast<cl_float>(light.caustics->filter.radius));
  add_.setArg(index + 12, static_cast<cl_uint>(samples));
  add_.setArg(index + 13, static_cast<cl_uint>(std::min(samples, causticSamples)));
}

void CachedLightAdder::add(std::uint32_t count, const Buffer<device::Ray>& rays,
                           const Buffer<device::Hit>& hits, const Buffer<std::uint32_t>& queue,
                           const cl::Buffer& paths) {
  setArguments(add_, count, rays.get(), hits.get(), queue.get(), paths);
  scene_.context().launch(add_, count, groupSize);
}

}  // namespace prelight::reference
