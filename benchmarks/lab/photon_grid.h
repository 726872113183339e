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

/// An alternative to the library's photon trees, which it is compared with: one uniform grid per region, with
/// photons sorted by cell. It knows only fronts of planar regions.
class PhotonGridEstimator {
 public:
  /// `nearest`: number of nearest photons per query; 0: all within the radius.
  PhotonGridEstimator(const DensitySurface& surface, int nearest, const Device& device);

  /// Cells hold about `photonsPerCell` evenly spread photons. If `cellSize` is not 0, they are that wide, m,
  /// and there are at most 16 per photon.
  void setPhotons(std::span<const device::Photon> photons, double photonsPerCell, double cellSize);

  void estimate(const Buffer<device::DensityQuery>& queries, std::size_t count, Buffer<float>& irradiance);

 private:
  DensitySurface surface_;
  DeviceContext& device_;
  device::DensityParameters values_{};
  Buffer<device::DensityParameters> parameters_;
  Buffer<device::PhotonGrid> grids_;
  Buffer<std::uint32_t> starts_;
  Buffer<float> members_;  ///< arrays x, y, z, red, green, blue, one after the other
  std::uint32_t memberLength_ = 0;
  DensityEstimator maps_;  ///< maps of the surface
  Kernel<Buffer<device::DensityParameters>, Buffer<device::DensityLine>, Buffer<device::PhotonGrid>,
         Buffer<std::uint32_t>, Buffer<float>, std::uint32_t, Buffer<device::DensityQuery>, Buffer<float>>
      estimate_;
};

}  // namespace prelight::benchmarks
