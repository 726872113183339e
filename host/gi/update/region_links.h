#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <unordered_map>
#include <vector>

#include "gi/update/live_approximation.h"
#include "scene/surface_regions.h"

namespace prelight {

/// Which regions of the surface see which others, as mean form factors that the rays of gathered texels have
/// sampled so far. They predict where light that has changed on one region changes others.
class RegionLinks {
 public:
  /// `relays`, [region], is 1 for mirrors, glass and glossy surfaces, which pass on what they see.
  RegionLinks(const SurfaceRegions& regions, std::vector<std::uint8_t> relays);

  /// Adds the triangles that rays from a region have met, or none.
  void add(std::uint32_t region, std::span<const std::uint32_t> triangles);

  /// Ends a pass in which every region reported what it sees. Beyond twice that number of rays, new reports
  /// displace older ones.
  void endPass();

  /// Adds to `expected`, [region], the changes due to changed irradiance elsewhere, W/m2, as if all surfaces
  /// were white. Relays do not pass on changes below `least`.
  void spread(std::span<const RegionChange> changes, double least, std::span<double> expected) const;

 private:
  void spreadFrom(const RegionChange& change, std::optional<double> least, std::span<double> expected) const;
  double formFactor(std::uint32_t from, std::uint32_t to) const;

  std::vector<std::uint32_t> regionOf_;  ///< [triangle]
  std::vector<double> areas_;
  std::vector<std::uint8_t> relays_;
  std::vector<double> most_;  ///< [region], number of rays beyond which older ones count half
  std::vector<double> rays_;  ///< [region]
  std::vector<std::unordered_map<std::uint32_t, double>> hits_;  ///< [region], number of hits by region
  std::vector<std::vector<std::uint32_t>> neighbours_;  ///< [region], regions that see it or that it sees
};

}  // namespace prelight
