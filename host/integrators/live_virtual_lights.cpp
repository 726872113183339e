#include "integrators/live_virtual_lights.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "integrators/camera_rays.h"
#include "integrators/virtual_lights.h"

namespace prelight {

namespace {

reference::ReferenceRequest requestOf(const InstantOptions& options) {
  reference::ReferenceRequest request;
  request.integrator = reference::Integrator::Instant;
  request.lightPaths = options.paths;
  request.depth = options.depth;
  request.seed = options.seed;
  return request;
}

}  // namespace

LiveVirtualLights::LiveVirtualLights(const Scene& scene, CompiledScene compiled, const Environment* sky,
                                     double skyRotation, const InstantOptions& options, const Device& device,
                                     Progress& progress)
    : scene_(scene, std::move(compiled)),
      options_(options),
      transport_({scene_.compiled(), scene.images, scene_.compiled().lights, sky, skyRotation}, device),
      skyRotation_(skyRotation) {
  lights_.renewals = options.renewals;
  makePhotons(progress);
  makeLights();
}

/// Makes the photons with programs for the lights that shine. If most paths make no virtual light, as under a
/// sky, more paths are sent until about the requested number makes one each.
void LiveVirtualLights::makePhotons(Progress& progress) {
  constexpr double mostMore = 64.0;
  const reference::ReferenceRequest request = requestOf(options_);
  const BuildOptions build = reference::buildOptions(request, std::nullopt, transport_.options());
  maker_ = std::make_unique<VirtualLightMaker>(transport_, build);
  LivePhotonOptions photons;
  photons.request = reference::lightPathsOf(request, 0);
  power_ = std::make_unique<VirtualLightPower>(scene_.compiled(), transport_, photons.request, build);
  power_->trace(progress);
  const double more = std::clamp(1.0 / std::max(power_->lightsPerPath(), 1e-9), 1.0, mostMore);
  photons.request.photons =
      static_cast<std::uint64_t>(std::llround(more * static_cast<double>(options_.paths)));
  photons.groupSize = 0;
  photons.photonsPerFrame = static_cast<std::uint32_t>(std::lround(more * options_.renewals));
  photons_ = std::make_unique<LivePhotons>(scene_, transport_, photons, progress);
}

void LiveVirtualLights::makeLights() {
  const std::vector<device::Photon> photons = photons_->photons();
  lights_.lights.resize(photons.size());
  if (!photons.empty()) maker_->make(photons).read(std::span(lights_.lights));
  lights_.leastSquare = options_.nearest > 0.0 ? static_cast<float>(options_.nearest * options_.nearest)
                                               : leastSquareOf(scene_.compiled(), photons.size());
  power_->share(lights_.lights, lights_.leastSquare);
}

void LiveVirtualLights::setSkyRotation(double angle) {
  transport_.setSkyRotation(angle);
  skyRotation_ = angle;
  skyTurned_ = true;
}

bool LiveVirtualLights::advance(Progress& progress) {
  SceneChange change = scene_.takeChanges();
  change.sky = std::exchange(skyTurned_, false);
  if (!change.empty()) {
    if (followChange(change, scene_, moving_, transport_)) {
      makePhotons(progress);
      makeLights();
      return true;
    }
    photons_->changed(change);
    power_->trace(progress);
  }
  PhotonDelta delta;
  photons_->advance(delta, progress);
  if (change.empty() && delta.removed.empty() && delta.added.empty()) return false;
  makeLights();
  return true;
}

}  // namespace prelight
