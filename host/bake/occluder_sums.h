#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "bake/fit_mesh.h"
#include "bake/surface_sampler.h"
#include "shared/occluder_types.h"

namespace prelight {

/// Right-hand sides of a vertex fit, sparse: for every slot those of the occluders that are seen around it.
class OccluderRightSides {
 public:
  /// Of device::OccluderSums: form factor, direction, offset, distance, normal, accessibility, colour.
  static constexpr std::size_t columns = 15;

  explicit OccluderRightSides(const FitMesh& mesh) : mesh_(mesh), entries_(mesh.slotCount()) {}

  void add(const SurfaceSample& sample, double weight, const device::OccluderSums& sums);

  /// Adds occluder `group`'s columns to rightSide [slot][width], from column `first` on.
  void scatter(std::uint32_t group, std::span<double> rightSide, std::size_t width, std::size_t first) const;

  /// Occluders that were seen around a slot or its neighbours, ascending.
  std::vector<std::uint32_t> groupsNear(std::uint32_t slot) const;

 private:
  struct Entry {
    std::uint32_t group = 0;
    std::array<double, columns> sums{};
  };

  const FitMesh& mesh_;
  std::vector<std::vector<Entry>> entries_;  ///< [slot]
};

}  // namespace prelight
