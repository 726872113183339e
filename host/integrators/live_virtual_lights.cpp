#include "integrators/live_virtual_lights.h"

#include <utility>

#include "integrators/reference_plan.h"
#include "integrators/virtual_lights.h"

namespace prelight {

namespace {

reference::ReferenceRequest requestOf(const VirtualLightOptions& options) {
  reference::ReferenceRequest request;
  request.integrator = reference::Integrator::Instant;
  request.lightPaths = options.paths;
  request.depth = options.depth;
  request.seed = options.seed;
  return request;
}

}  // namespace

LiveVirtualLights::LiveVirtualLights(const Scene& scene, CompiledScene compiled, const Environment* sky,
                                     double skyRotation, const VirtualLightOptions& options,
                                     const Device& device, Progress& progress)
    : scene_(scene, std::move(compiled)),
      options_(options),
      transport_({scene_.compiled(), scene.images, scene_.compiled().lights, sky, skyRotation}, device),
      skyRotation_(skyRotation) {
  lights_.renewals = options.renewals;
  makePhotons(progress);
  makeLights();
}

/// With programs for the lights that shine.
void LiveVirtualLights::makePhotons(Progress& progress) {
  const reference::ReferenceRequest request = requestOf(options_);
  maker_ = std::make_unique<VirtualLightMaker>(
      transport_, reference::buildOptions(request, std::nullopt, transport_.options()));
  LivePhotonOptions photons;
  photons.request = reference::lightPathsOf(request, 0);
  photons.groupSize = 0;
  photons.photonsPerFrame = options_.renewals;
  photons_ = std::make_unique<LivePhotons>(scene_, transport_, photons, progress);
}

void LiveVirtualLights::makeLights() {
  const std::vector<device::Photon> photons = photons_->photons();
  lights_.lights.resize(photons.size());
  if (!photons.empty()) maker_->make(photons).read(std::span(lights_.lights));
  lights_.leastSquare = options_.nearest > 0.0 ? static_cast<float>(options_.nearest * options_.nearest)
                                               : leastSquareOf(scene_.compiled(), photons.size());
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
  }
  PhotonDelta delta;
  photons_->advance(delta, progress);
  if (delta.removed.empty() && delta.added.empty()) return false;
  makeLights();
  return true;
}

}  // namespace prelight
