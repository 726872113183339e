#pragma once

#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "prelight/compiled_scene.h"
#include "shared/photon_path_types.h"

namespace prelight {

/// An importon where it landed.
struct LandedImporton {
  glm::dvec3 position{0.0};  ///< scene coordinates
  double power = 0.0;        ///< power, for an eye that emits 1
};

/// Importance of a watt that lands at a place for an eye: the density of importons on the surface (Peter and
/// Pietrek 1998), 1/m2, in cubes of space. Where few importons landed, the density of larger cubes is used.
class ImportanceMap {
 public:
  ImportanceMap(const CompiledScene& scene, std::span<const LandedImporton> importons);

  double at(const glm::dvec3& position) const { return values_[cellOf(position)]; }

  const device::ImportanceGrid& grid() const { return grid_; }
  std::span<const double> values() const { return values_; }  ///< [z][y][x], above 0 where an importon landed

 private:
  std::size_t cellOf(const glm::dvec3& position) const;
  std::vector<double> gathered(std::span<const LandedImporton> points) const;

  device::ImportanceGrid grid_{};
  std::vector<double> values_;
};

}  // namespace prelight
