#pragma once

#include <span>
#include <vector>

#include "device/kernel.h"
#include "photon/density_estimator.h"
#include "photon/density_surface.h"
#include "prelight/device.h"
#include "shared/density_types.h"
#include "shared/photon_types.h"

namespace prelight::benchmarks {

/// The other way to find photons, measured beside the library's trees: a uniform grid a region, photons
/// sorted by cell. Fronts of planar regions only.
class PhotonGridEstimator {
 public:
  /// nearest: k, 0: all within the radius.
  PhotonGridEstimator(const DensitySurface& surface, int nearest, const Device& device);

  /// Cells hold about `photonsPerCell` where photons are spread evenly, or are `cellSize` m wide if that is
  /// not 0 (and there are then no more than 16 a photon).
  void setPhotons(std::span<const device::Photon> photons, double photonsPerCell, double cellSize);

  void estimate(const Buffer<device::DensityQuery>& queries, std::size_t count, Buffer<float>& irradiance);

 private:
  DensitySurface surface_;
  DeviceContext& device_;
  device::DensityParameters values_{};
  Buffer<device::DensityParameters> parameters_;
  Buffer<device::PhotonGrid> grids_;
  Buffer<std::uint32_t> starts_;
  Buffer<float> members_;  ///< x, y, z, red, green, blue, one after the other
  std::uint32_t memberLength_ = 0;
  DensityEstimator maps_;  ///< maps over the surface that is read
  Kernel<Buffer<device::DensityParameters>, Buffer<device::DensityLine>, Buffer<device::PhotonGrid>,
         Buffer<std::uint32_t>, Buffer<float>, std::uint32_t, Buffer<device::DensityQuery>, Buffer<float>>
      estimate_;
};

}  // namespace prelight::benchmarks
