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

/// How photons count by their distance; all are divided by their integral.
enum class DensityKernel : std::uint8_t {
  Constant = 0,
  Cone = 1,          ///< 1 - d / r
  Epanechnikov = 2,  ///< 1 - d2 / r2: least error for a number of photons
};

struct DensityOptions {
  DensityKernel kernel = DensityKernel::Epanechnikov;
  int nearest = 0;           ///< k of the k nearest photons, 2..4096; 0: all within a query's radius
  double minRadius = 0.0;    ///< m, with k nearest: no closer, so that a sharp focus keeps its noise bounded
  double leastCosine = 0.5;  ///< between normals of the query's triangle and a photon's, of the same region
  double flatness = 0.5;     ///< largest distance of the query from a photon's plane, in radii; > 0
};

/// Irradiance from photon maps on a device. Photons count for queries on the same region of the surface, or
/// the same patch of one, and the same side.
class DensityEstimator {
 public:
  /// Throws UsageError for options out of range.
  DensityEstimator(const DensitySurface& surface, const DensityOptions& options, const Device& device);
  DensityEstimator(const DensitySurface& surface, const DensityOptions& options, DeviceContext& device);

  /// Takes the surface to where it is now, see followDensitySurface.
  void follow(const DensitySurface& surface);

  /// From now on these photons count, which are sorted by regions, or by patches of them of which the first
  /// have the regions' numbers.
  void setPhotons(const PhotonMaps& maps);

  /// Irradiance, W/m2, [query]. Deterministic: sums run in the order of the maps.
  std::vector<glm::vec3> estimate(std::span<const device::DensityQuery> queries);

  /// The same with the directions that photons came from: irradiance, W/m2, and incident radiance in SH of
  /// an order, [query][channel][value] (basis/incident_values.h).
  std::vector<float> estimateIncident(std::span<const device::DensityQuery> queries,
                                      int order = leastIncidentOrder);

  /// Densities by which rays are drawn where photons came from: [query][PRELIGHT_GUIDE_CELLS], of mean 1 and
  /// above 0 (kernels/gather/guided_kernels.cl). Here the queries' normals are those that rays are drawn
  /// around.
  std::vector<float> guides(std::span<const device::DensityQuery> queries);

  /// Irradiance on the device: the first `count` queries -> irradiance [query][3].
  void estimate(const Buffer<device::DensityQuery>& queries, std::size_t count, Buffer<float>& irradiance);

  /// Options for programs that include kernels/photon/density_funcs.cl.
  static BuildOptions& addOptions(BuildOptions& options, const DensityOptions& density);

  /// What kernels take that look maps up themselves; both change with setPhotons().
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
  Buffer<device::DensityLine> lines_;  ///< of the surface, then of the photons
  std::size_t mapCount_ = 0;
  Estimate estimate_, estimateIncident_, guides_;  ///< once they are needed
  int incidentOrder_ = 0;                          ///< of estimateIncident_
};

}  // namespace prelight
