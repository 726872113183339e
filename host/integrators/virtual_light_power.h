#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "gpu/transport_scene.h"
#include "integrators/virtual_light_maker.h"
#include "photon/photon_tracer.h"

namespace prelight {

/// The power of a few virtual lights, from many more light paths than theirs. Few paths, which are absorbed
/// by chance, tell well where light leaves surfaces, and badly how much.
class VirtualLightPower {
 public:
  /// The scenes outlive it. `paths`: of the few lights; `options`: of VirtualLightMaker.
  VirtualLightPower(const CompiledScene& compiled, TransportScene& scene, const PhotonRequest& paths,
                    const BuildOptions& options);

  /// Follows the many paths through the scene as it is. Throws Interrupted.
  void trace(Progress& progress);

  /// Virtual lights that a path leaves in the mean.
  double lightsPerPath() const {
    return static_cast<double>(many_.size()) / static_cast<double>(request_.photons);
  }

  /// Gives each light the power of those of the many that are nearest to it, and all of them the factor that
  /// makes as much of their light meet surfaces as of the many's. Then sets what each sends near places
  /// (VirtualLight::nearby).
  void share(std::span<device::VirtualLight> lights, float leastSquare);

 private:
  const CompiledScene& compiled_;
  PhotonRequest request_;
  PhotonTracer tracer_;
  VirtualLightMaker maker_;
  VirtualLightReach reach_;
  std::vector<device::VirtualLight> many_;
  glm::dvec3 met_{0.0};  ///< sum of the many's intensities whose ray met a surface
};

}  // namespace prelight
