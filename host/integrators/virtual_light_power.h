#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "gpu/transport_scene.h"
#include "integrators/virtual_lights.h"
#include "photon/photon_tracer.h"

namespace prelight {

/// Estimates the power of a few virtual lights from many more light paths than theirs. A few paths with
/// random absorption represent well where light leaves surfaces, but badly how much.
class VirtualLightPower {
 public:
  /// The scenes must outlive the object. `paths` are those of the few lights, and `options` those of
  /// VirtualLightMaker.
  VirtualLightPower(const CompiledScene& compiled, TransportScene& scene, const PhotonRequest& paths,
                    const BuildOptions& options);

  /// Traces the many paths through the present scene. Throws Interrupted.
  void trace(Progress& progress);

  /// Returns the mean number of virtual lights per path.
  double lightsPerPath() const {
    return static_cast<double>(many_.size()) / static_cast<double>(request_.photons);
  }

  /// Gives each light the power of those of the many lights that are nearest to it, and scales all of them
  /// such that as much of their light meets surfaces as of the many lights'. Then sets VirtualLight::nearby.
  void share(std::span<device::VirtualLight> lights, float leastSquare);

 private:
  const CompiledScene& compiled_;
  PhotonRequest request_;
  PhotonTracer tracer_;
  VirtualLightMaker maker_;
  VirtualLightReach reach_;
  std::vector<device::VirtualLight> many_;
  glm::dvec3 met_{0.0};  ///< sum of intensities of those of the many lights whose ray hit a surface
};

}  // namespace prelight
