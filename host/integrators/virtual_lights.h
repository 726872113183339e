#pragma once

#include <cstdint>

#include "gpu/transport_scene.h"
#include "integrators/reference.h"
#include "integrators/virtual_light_maker.h"
#include "photon/photon_tracer.h"

namespace prelight::reference {

/// The light paths that leave the virtual lights of a pass, for a depth of 3 or more.
PhotonRequest lightPathsOf(const ReferenceRequest& request, std::uint64_t pass);

/// Virtual point lights of instant radiosity (Keller 1997), a set of its own for every pass: where light
/// paths meet diffuse surfaces, what they bring is sent on as from a point.
class VirtualLights {
 public:
  /// The scene outlives it.
  VirtualLights(TransportScene& scene, const CompiledScene& compiled, const ReferenceRequest& request);

  /// Those of a pass.
  void make(std::uint64_t pass);

  std::uint32_t count() const { return count_; }
  const Buffer<device::VirtualLight>& lights() const { return lights_; }
  std::uint64_t rays() const { return rays_; }        ///< of light paths so far
  float leastSquare() const { return leastSquare_; }  ///< leastSquareOf() them

 private:
  const CompiledScene& compiled_;
  ReferenceRequest request_;
  PhotonTracer tracer_;
  VirtualLightMaker maker_;
  VirtualLightReach reach_;
  std::vector<device::VirtualLight> made_;
  Buffer<device::VirtualLight> lights_;
  std::uint32_t count_ = 0;
  std::uint64_t rays_ = 0;
  float leastSquare_ = 0.0f;
};

}  // namespace prelight::reference
