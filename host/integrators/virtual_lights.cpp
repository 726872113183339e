#include "integrators/virtual_lights.h"

#include <algorithm>
#include <numbers>

#include "integrators/camera_rays.h"

namespace prelight {

using namespace device;

namespace {

constexpr std::uint32_t raysOfLight = 256;
constexpr double mostNear = 64.0;

}  // namespace

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

VirtualLightReach::VirtualLightReach(TransportScene& scene, const BuildOptions& options)
    : scene_(scene),
      cast_(scene.context(), "integrate/virtual_kernels.cl", options, "castFromVirtualLights") {}

std::vector<float> VirtualLightReach::distances(const Buffer<VirtualLight>& lights, std::size_t count,
                                                std::uint32_t rays) {
  const auto all = static_cast<std::uint32_t>(count * rays);
  std::vector<float> distances(all, nothing);
  if (all == 0) return distances;
  if (rays_.size() < all) {
    rays_ = Buffer<Ray>(scene_.context(), 2 * std::size_t{all});
    hits_ = Buffer<Hit>(scene_.context(), 2 * std::size_t{all});
  }
  cast_.launch(all, all, rays, lights, rays_);
  scene_.tracer().traceClosest(rays_, hits_, all, 0);
  std::vector<Hit> hits(all);
  hits_.read(std::span(hits));
  for (std::size_t i = 0; i < all; ++i)
    if (hits[i].triangle != PRELIGHT_NO_TRIANGLE) distances[i] = hits[i].t;
  return distances;
}

std::vector<double> VirtualLightReach::setNear(std::span<VirtualLight> lights, float leastSquare) {
  if (lights_.size() < lights.size()) lights_ = Buffer<VirtualLight>(scene_.context(), 2 * lights.size());
  lights_.write(std::span<const VirtualLight>(lights));
  const std::vector<float> distances = this->distances(lights_, lights.size(), raysOfLight);
  std::vector<double> shares;
  for (std::size_t k = 0; k < lights.size(); ++k) {
    double met = 0.0, lost = 0.0, room = 0.0;
    for (std::uint32_t i = 0; i < raysOfLight; ++i) {
      const double distance = double{distances[k * raysOfLight + i]};
      if (!(distance < double{nothing})) continue;
      const double kept = std::min(distance * distance / double{leastSquare}, 1.0);
      met += 1.0;
      lost += 1.0 - kept;
      room += kept * (1.0 - kept);
    }
    lights[k].nearby = static_cast<float>(room > 0.0 ? std::min(lost / room, mostNear) : 0.0);
    shares.push_back(met / raysOfLight);
  }
  return shares;
}

float leastSquareOf(const CompiledScene& compiled, std::size_t lights) {
  double area = 0.0;
  for (std::uint32_t t = 0; t < compiled.triangleCount(); ++t)
    area += 0.5 * glm::length(geometricNormal(compiled, t));
  return lights == 0 ? 0.0f : static_cast<float>(area / (std::numbers::pi * static_cast<double>(lights)));
}

}  // namespace prelight

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
