#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "gpu/transport_scene.h"
#include "integrators/reference.h"
#include "photon/photon_tracer.h"
#include "shared/photon_types.h"
#include "shared/reference_types.h"

namespace prelight {

/// Makes virtual point lights (Keller 1997) from photons: a diffuse surface reflects the power of a photon as
/// from a point.
class VirtualLightMaker {
 public:
  /// The scene must outlive the object. `options` are those of the kernel.
  VirtualLightMaker(TransportScene& scene, const BuildOptions& options);

  /// Returns the lights of the photons, [photon]. The buffer may be longer, and the next call reuses it.
  const Buffer<device::VirtualLight>& make(std::span<const device::Photon> photons);
  const Buffer<device::VirtualLight>& lights() const { return lights_; }
  DeviceContext& context() const { return scene_.context(); }

 private:
  TransportScene& scene_;
  Buffer<device::Photon> photons_;
  Buffer<device::VirtualLight> lights_;
  Kernel<std::uint32_t, Buffer<device::SceneLayout>, Buffer<device::SurfaceLine>, Buffer<device::ShadingLine>,
         Buffer<device::Photon>, Buffer<device::VirtualLight>>
      make_;
};

/// Finds by rays what the light of virtual lights reaches.
class VirtualLightReach {
 public:
  /// Distance of a ray that met nothing, m.
  static constexpr float nothing = 3e38f;

  /// The scene must outlive the object. `options` are those of the kernel.
  VirtualLightReach(TransportScene& scene, const BuildOptions& options);

  /// Returns distances in metres along cosine-weighted rays, [light][ray].
  std::vector<float> distances(const Buffer<device::VirtualLight>& lights, std::size_t count,
                               std::uint32_t rays);

  /// Sets VirtualLight::nearby, which compensates for clamping: places nearer than the root of `leastSquare`
  /// are lit as from that distance, and `nearby` adds the lost light there. Returns for each light the share
  /// of its rays that hit a surface.
  std::vector<double> setNear(std::span<device::VirtualLight> lights, float leastSquare);

 private:
  TransportScene& scene_;
  Buffer<device::VirtualLight> lights_;
  Buffer<device::Ray> rays_;
  Buffer<device::Hit> hits_;
  Kernel<std::uint32_t, std::uint32_t, Buffer<device::VirtualLight>, Buffer<device::Ray>> cast_;
};

/// Returns the squared radius, m2, of the disc that each of `lights` lights represents. Nearer places are lit
/// as from that radius, since single lights would otherwise make bright spots in corners.
float leastSquareOf(const CompiledScene& compiled, std::size_t lights);

}  // namespace prelight

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
