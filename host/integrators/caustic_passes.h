#pragma once

#include <cstdint>
#include <memory>

#include "gpu/transport_scene.h"
#include "integrators/reference.h"
#include "photon/density_estimator.h"
#include "photon/density_surface.h"
#include "photon/photon_tracer.h"

namespace prelight::reference {

/// Photons of punctual lights that mirrors and smooth glass scatter onto other surfaces, a set of its own for
/// every pass. Paths of a camera cannot meet such lights, so that they look these photons up. The radius
/// within which they count shrinks from pass to pass (Knaus and Zwicker 2011): noise and blur of the mean of
/// all passes fall together.
class CausticPasses {
 public:
  /// Whether a request for a scene has such light to look for.
  static bool areNeeded(const TransportScene& scene, const CompiledScene& compiled,
                        const ReferenceRequest& request);

  /// Sends a pilot's photons. All outlive it. `pathsPerPass`: of a whole picture.
  CausticPasses(TransportScene& scene, const CompiledScene& compiled, const ReferenceRequest& request,
                std::uint64_t pathsPerPass);

  /// False: no photon of the pilot has landed.
  bool any() const { return firstRadius_ > 0.0; }

  /// Those of a pass.
  void make(std::uint64_t pass);

  float radius() const { return radius_; }  ///< m
  const Buffer<device::DensityParameters>& parameters() const { return parameters_; }
  const Buffer<device::DensityLine>& lines() const { return estimator_.lines(); }
  std::uint64_t rays() const { return rays_; }  ///< of photons so far

 private:
  PhotonHits send(std::uint64_t seed, std::uint64_t photons);

  const CompiledScene& compiled_;
  TransportScene& scene_;
  ReferenceRequest request_;
  std::uint64_t photons_;
  PhotonTracer tracer_;
  DensitySurface surface_;
  DensityEstimator estimator_;
  Buffer<device::DensityParameters> parameters_;
  double firstRadius_ = 0.0;  ///< m
  float radius_ = 0.0f;
  std::uint64_t rays_ = 0;
};

}  // namespace prelight::reference
