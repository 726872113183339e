#pragma once

#include <cstdint>

#include "gpu/transport_scene.h"
#include "integrators/reference.h"
#include "photon/photon_tracer.h"
#include "shared/reference_types.h"

namespace prelight::reference {

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
  std::uint64_t rays() const { return rays_; }  ///< of light paths so far

  /// m2: of the disc that a light stands for, the scene's surface over their number. What is nearer than its
  /// radius counts as at that distance: else single lights shine as bright spots in corners.
  float leastSquare() const { return leastSquare_; }

 private:
  TransportScene& scene_;
  ReferenceRequest request_;
  PhotonTracer tracer_;
  double area_ = 0.0;
  std::uint32_t count_ = 0;
  std::uint64_t rays_ = 0;
  float leastSquare_ = 0.0f;
  Buffer<device::Photon> photons_;
  Buffer<device::VirtualLight> lights_;
  Kernel<std::uint32_t, Buffer<device::SceneLayout>, Buffer<device::SurfaceLine>, Buffer<device::ShadingLine>,
         Buffer<device::Photon>, Buffer<device::VirtualLight>>
      make_;
};

}  // namespace prelight::reference
