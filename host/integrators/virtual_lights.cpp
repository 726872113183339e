#include "integrators/virtual_lights.h"

#include "integrators/reference_plan.h"

namespace prelight::reference {

PhotonRequest lightPathsOf(const ReferenceRequest& request, std::uint64_t pass) {
  PhotonRequest photons;
  photons.kind = PhotonKind::All;
  photons.aimed = false;
  photons.photons = request.lightPaths;
  photons.seed = request.seed + 0x9e3779b97f4a7c15u * (pass + 1);
  photons.depth = request.depth - 2;  // segments left between camera and virtual light
  return photons;
}

VirtualLights::VirtualLights(TransportScene& scene, const CompiledScene& compiled,
                             const ReferenceRequest& request)
    : compiled_(compiled),
      request_(request),
      tracer_(compiled, scene),
      maker_(scene, buildOptions(request, std::nullopt, scene.options())),
      reach_(scene, buildOptions(request, std::nullopt, scene.options())),
      lights_(scene.context(), 0) {}

void VirtualLights::make(std::uint64_t pass) {
  count_ = 0;
  if (request_.depth < 3) return;
  PhotonHits hits;
  Progress progress;
  rays_ += tracer_.trace(lightPathsOf(request_, pass), hits, progress).rays;
  count_ = static_cast<std::uint32_t>(hits.photons.size());
  if (count_ == 0) return;
  leastSquare_ = leastSquareOf(compiled_, count_);
  made_.resize(count_);
  maker_.make(hits.photons).read(std::span(made_));
  reach_.setNear(made_, leastSquare_);
  if (lights_.size() < count_)
    lights_ = Buffer<device::VirtualLight>(maker_.context(), 2 * std::size_t{count_});
  lights_.write(std::span<const device::VirtualLight>(made_));
}

}  // namespace prelight::reference
