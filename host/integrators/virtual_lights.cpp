#include "integrators/virtual_lights.h"

#include <algorithm>
#include <numbers>

#include "integrators/reference_plan.h"

namespace prelight::reference {

using namespace device;

VirtualLights::VirtualLights(TransportScene& scene, const CompiledScene& compiled,
                             const ReferenceRequest& request)
    : scene_(scene),
      request_(request),
      tracer_(compiled, scene),
      make_(scene.context(), "integrate/virtual_kernels.cl",
            buildOptions(request, std::nullopt, scene.options()), "makeVirtualLights") {
  for (std::uint32_t t = 0; t < compiled.triangleCount(); ++t)
    area_ += 0.5 * glm::length(geometricNormal(compiled, t));
}

void VirtualLights::make(std::uint64_t pass) {
  count_ = 0;
  if (request_.depth < 3) return;
  PhotonRequest photons;
  photons.kind = PhotonKind::All;
  photons.aimed = false;
  photons.photons = request_.lightPaths;
  photons.seed = request_.seed + 0x9e3779b97f4a7c15u * (pass + 1);
  photons.depth = request_.depth - 2;  // what remains of a path between camera and virtual light
  PhotonHits hits;
  Progress progress;
  rays_ += tracer_.trace(photons, hits, progress).rays;
  count_ = static_cast<std::uint32_t>(hits.photons.size());
  if (count_ == 0) return;
  leastSquare_ = static_cast<float>(area_ / (std::numbers::pi * count_));
  DeviceContext& device = scene_.context();
  if (lights_.size() < count_) {
    photons_ = Buffer<Photon>(device, 2 * count_);
    lights_ = Buffer<VirtualLight>(device, 2 * count_);
  }
  photons_.write(std::span<const Photon>(hits.photons));
  const DeviceScene& handle = scene_.handle();
  make_.launch(count_, count_, handle.layoutBuffer(), handle.surface(), handle.shading(), photons_, lights_);
}

}  // namespace prelight::reference
