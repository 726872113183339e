#include "integrators/virtual_light_maker.h"

#include <numbers>

namespace prelight {

using namespace device;

VirtualLightMaker::VirtualLightMaker(TransportScene& scene, const BuildOptions& options)
    : scene_(scene), make_(scene.context(), "integrate/virtual_kernels.cl", options, "makeVirtualLights") {}

const Buffer<VirtualLight>& VirtualLightMaker::make(std::span<const Photon> photons) {
  const auto count = static_cast<std::uint32_t>(photons.size());
  if (count == 0) return lights_;
  if (lights_.size() < count) {
    photons_ = Buffer<Photon>(scene_.context(), 2 * std::size_t{count});
    lights_ = Buffer<VirtualLight>(scene_.context(), 2 * std::size_t{count});
  }
  photons_.write(photons);
  const DeviceScene& handle = scene_.handle();
  make_.launch(count, count, handle.layoutBuffer(), handle.surface(), handle.shading(), photons_, lights_);
  return lights_;
}

float leastSquareOf(const CompiledScene& compiled, std::size_t lights) {
  double area = 0.0;
  for (std::uint32_t t = 0; t < compiled.triangleCount(); ++t)
    area += 0.5 * glm::length(geometricNormal(compiled, t));
  return lights == 0 ? 0.0f : static_cast<float>(area / (std::numbers::pi * static_cast<double>(lights)));
}

}  // namespace prelight
