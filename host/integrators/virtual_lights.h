#pragma once

#include <cstdint>

#include "gpu/transport_scene.h"
#include "integrators/reference.h"
#include "integrators/virtual_light_maker.h"
#include "photon/photon_tracer.h"

namespace prelight::reference {

/// Returns the request for the light paths that make the virtual lights of a pass, for a depth >= 3.
PhotonRequest lightPathsOf(const ReferenceRequest& request, std::uint64_t pass);

/// Virtual point lights of instant radiosity (Keller 1997), a new set for each pass: where light paths meet
/// diffuse surfaces, their power is reflected as from a point.
class VirtualLights {
 public:
  /// The scene must outlive the object.
  VirtualLights(TransportScene& scene, const CompiledScene& compiled, const ReferenceRequest& request);

  /// Makes the lights of a pass.
  void make(std::uint64_t pass);

  std::uint32_t count() const { return count_; }
  const Buffer<device::VirtualLight>& lights() const { return lights_; }
  std::uint64_t rays() const { return rays_; }        ///< rays of all light paths so far
  float leastSquare() const { return leastSquare_; }  ///< leastSquareOf() the lights

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
