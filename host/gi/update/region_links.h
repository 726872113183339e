#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <unordered_map>
#include <vector>

#include "gi/update/live_approximation.h"
#include "scene/surface_regions.h"

namespace prelight {

/// Which regions of the surface see which, and how much of their view these take: mean form factors, as rays
/// of gathered texels have told so far. They say where light that has changed on one region changes others.
class RegionLinks {
 public:
  /// `relays`, [region], 1: mirrors, glass and glossy surfaces, which pass on what they see.
  RegionLinks(const SurfaceRegions& regions, std::vector<std::uint8_t> relays);

  /// Rays from a region met these triangles, or none.
  void add(std::uint32_t region, std::span<const std::uint32_t> triangles);

  /// Every region has told once what it sees: what it tells beyond twice that displaces what it told before.
  void endPass();

  /// Adds to `expected`, [region], what changes of irradiance elsewhere bring about there, W/m2, as if all
  /// surfaces were white.
  void spread(std::span<const RegionChange> changes, double least, std::span<double> expected) const;

 private:
  void spreadFrom(const RegionChange& change, std::optional<double> least, std::span<double> expected) const;
  double formFactor(std::uint32_t from, std::uint32_t to) const;

  std::vector<std::uint32_t> regionOf_;  ///< [triangle]
  std::vector<double> areas_;
  std::vector<std::uint8_t> relays_;
  std::vector<double> most_;  ///< [region] rays before older ones count half
  std::vector<double> rays_;  ///< [region]
  std::vector<std::unordered_map<std::uint32_t, double>> hits_;  ///< [region], by region
  std::vector<std::vector<std::uint32_t>> neighbours_;  ///< [region], those that see it or that it sees
};

}  // namespace prelight
