#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "bake/fit_mesh.h"
#include "bake/surface_sampler.h"
#include "shared/occluder_types.h"

namespace prelight {

/// What is seen of an occluder around a slot: device::OccluderSums in double, positions in scene coordinates.
struct SeenOccluder {
  std::uint32_t group = 0;
  double formFactor = 0.0;
  glm::dvec3 direction{0.0};
  glm::dvec3 position{0.0};  ///< times the form factor, as are offset, distance and colour
  glm::dvec3 offset{0.0};    ///< from receivers
  double distance = 0.0;
  glm::dvec3 normal{0.0};
  double accessibility = 0.0;
  glm::dvec3 color{0.0};

  SeenOccluder& operator+=(const SeenOccluder& other);
  SeenOccluder& operator*=(double factor);
};

/// Means of what receivers saw over the surface around slots, sparse by occluder. A receiver counts for a
/// corner of its triangle by its barycentric weight, so that nothing becomes negative, as it would in a
/// least-squares fit: a noisy part of an object would be there with either sign.
class OccluderMeans {
 public:
  explicit OccluderMeans(const FitMesh& mesh)
      : mesh_(mesh), weights_(mesh.slotCount(), 0.0), entries_(mesh.slotCount()) {}

  /// A receiver, once.
  void addReceiver(const SurfaceSample& sample, double weight);

  /// What it saw of one occluder.
  void add(const SurfaceSample& sample, double weight, const device::Receiver& receiver,
           const device::OccluderSums& sums);

  /// Ascending by group. A slot that no receiver is near has the mean of what lies around it, if anything is
  /// seen there.
  std::vector<SeenOccluder> around(std::uint32_t slot) const;

 private:
  std::vector<SeenOccluder> meanOver(const std::vector<std::uint32_t>& slots) const;

  const FitMesh& mesh_;
  std::vector<double> weights_;                     ///< [slot], of the receivers around
  std::vector<std::vector<SeenOccluder>> entries_;  ///< [slot]
};

}  // namespace prelight
