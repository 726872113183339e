#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "gpu/transport_scene.h"
#include "shared/photon_types.h"
#include "shared/reference_types.h"

namespace prelight {

/// Makes virtual point lights (Keller 1997) of photons: what these bring to diffuse surfaces is sent on as
/// from a point.
class VirtualLightMaker {
 public:
  /// The scene outlives it. `options`: of the kernel.
  VirtualLightMaker(TransportScene& scene, const BuildOptions& options);

  /// [photon] of them; the buffer may be longer, and is that of the next call, too.
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

/// What the light of virtual lights meets, by rays.
class VirtualLightReach {
 public:
  /// Distance of a ray that met nothing, m.
  static constexpr float nothing = 3e38f;

  /// The scene outlives it. `options`: of the kernel.
  VirtualLightReach(TransportScene& scene, const BuildOptions& options);

  /// [light][ray] metres to what cosine-weighted rays meet.
  std::vector<float> distances(const Buffer<device::VirtualLight>& lights, std::size_t count,
                               std::uint32_t rays);

  /// Sets VirtualLight::nearby such that what is lost where places nearer than the root of `leastSquare`
  /// count as at that distance is given back there. Returns the share of each light's rays that meets a
  /// surface.
  std::vector<double> setNear(std::span<device::VirtualLight> lights, float leastSquare);

 private:
  TransportScene& scene_;
  Buffer<device::VirtualLight> lights_;
  Buffer<device::Ray> rays_;
  Buffer<device::Hit> hits_;
  Kernel<std::uint32_t, std::uint32_t, Buffer<device::VirtualLight>, Buffer<device::Ray>> cast_;
};

/// m2: of the disc that one of so many lights stands for. What is nearer than its radius counts as at that
/// distance: else single lights shine as bright spots in corners.
float leastSquareOf(const CompiledScene& compiled, std::size_t lights);

}  // namespace prelight
