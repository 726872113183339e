#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "basis/incident_values.h"
#include "device/kernel.h"
#include "photon/density_surface.h"
#include "photon/photon_maps.h"
#include "prelight/device.h"

namespace prelight {

/// Weight of photons by distance, divided by the kernel's integral.
enum class DensityKernel : std::uint8_t {
  Constant = 0,
  Cone = 1,          ///< 1 - d / r
  Epanechnikov = 2,  ///< 1 - d2 / r2: least error for a given number of photons
};

/// Options of a density estimate.
struct DensityOptions {
  DensityKernel kernel = DensityKernel::Epanechnikov;
  int nearest = 0;  ///< k of the k nearest photons, 2..4096; 0: all photons within a query's radius
  /// m, least radius with k nearest photons, which bounds the noise in sharp focuses
  double minRadius = 0.0;
  /// Least cosine between the normals of a query's triangle and a photon's on the same region.
  double leastCosine = 0.5;
  double flatness = 0.5;  ///< largest distance of a query from a photon's plane, in radii; > 0
};

/// Estimates irradiance from photon maps on a device. Photons count for queries on the same side of the same
/// region of the surface, or of the same patch of a region.
class DensityEstimator {
 public:
  /// Throws UsageError for options out of range.
  DensityEstimator(const DensitySurface& surface, const DensityOptions& options, const Device& device);
  DensityEstimator(const DensitySurface& surface, const DensityOptions& options, DeviceContext& device);

  /// Updates the surface after it has moved, see followDensitySurface().
  void follow(const DensitySurface& surface);

  /// Sets the photons, which are sorted by regions, or by patches of which the first have the regions'
  /// numbers.
  void setPhotons(const PhotonMaps& maps);

  /// Returns irradiance, W/m2, [query]. The result is deterministic: sums are in the order of the maps.
  std::vector<glm::vec3> estimate(std::span<const device::DensityQuery> queries);

  /// Returns irradiance, W/m2, and incident radiance in SH of an order by the directions of photons,
  /// [query][channel][value] (basis/incident_values.h).
  std::vector<float> estimateIncident(std::span<const device::DensityQuery> queries,
                                      int order = leastIncidentOrder);

  /// Returns densities for sampling rays in directions that photons came from, [query][PRELIGHT_GUIDE_CELLS],
  /// with mean 1 and above 0 (kernels/gather/guided_kernels.cl). The queries' normals must be those that rays
  /// are distributed around.
  std::vector<float> guides(std::span<const device::DensityQuery> queries);

  /// Computes irradiance on the device for the first `count` queries, [query][3].
  void estimate(const Buffer<device::DensityQuery>& queries, std::size_t count, Buffer<float>& irradiance);

  /// Adds the options of programs that include kernels/photon/density_funcs.cl.
  static BuildOptions& addOptions(BuildOptions& options, const DensityOptions& density);

  /// Return the parameters and maps for kernels that look up maps themselves. setPhotons() changes both.
  const device::DensityParameters& parameters() const { return values_; }
  const Buffer<device::DensityLine>& lines() const { return lines_; }

 private:
  using Estimate = Kernel<Buffer<device::DensityParameters>, Buffer<device::DensityLine>,
                          Buffer<device::DensityQuery>, Buffer<float>>;

  void launch(Estimate& kernel, const Buffer<device::DensityQuery>& queries, std::size_t count,
              Buffer<float>& values);
  Estimate& estimateKernel();
  std::vector<float> estimateWith(Estimate& kernel, std::size_t length,
                                  std::span<const device::DensityQuery> queries);

  DeviceContext& device_;
  DensityOptions options_;
  device::DensityParameters values_{};
  Buffer<device::DensityParameters> parameters_;
  std::size_t surfaceLines_ = 0;
  Buffer<device::DensityLine> lines_;  ///< surface, followed by photons
  std::size_t mapCount_ = 0;
  Estimate estimate_, estimateIncident_, guides_;  ///< made when needed
  int incidentOrder_ = 0;                          ///< order of estimateIncident_
};

}  // namespace prelight
