#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "cast/column.h"
#include "techniques/vector_occluders/occluder_column.h"
#include "receivers/fit_mesh.h"
#include "receivers/surface_sampler.h"

namespace prelight {

/// What is seen of an occluder around a slot: sums over rays, each worth its share of form factor. Positions
/// in scene coordinates.
struct SeenOccluder {
  float formFactor = 0.0f;
  glm::vec3 direction{0.0f};
  glm::vec3 position{0.0f};  ///< times the form factor, as are offset, distance and colour
  glm::vec3 offset{0.0f};    ///< from receivers
  float distance = 0.0f;
  glm::vec3 normal{0.0f};
  float accessibility = 0.0f;
  glm::vec3 color{0.0f};

  void add(const SeenOccluder& other, float factor);
};

/// Where what is seen sends light on from.
struct SeenWays {
  glm::vec3 mirrorNormal{0.0f};      ///< of what is mirrored from the open
  float mirrorFactor = 0.0f;         ///< form factor of that
  glm::vec3 mirrorColor{0.0f};       ///< times that
  glm::vec3 throughDirection{0.0f};  ///< of what comes through glass from the open
  float throughFactor = 0.0f;
  glm::vec3 throughColor{0.0f};

  void add(const SeenWays& other, float factor);
};

/// A record: an occluder as it is seen.
struct OccluderSeen {
  std::uint32_t group = 0;
  SeenOccluder seen;
  SeenWays ways;
};

/// Means of what receivers saw over the surface around slots, sparse by occluder. A receiver counts for a
/// corner of its triangle by its barycentric weight, so that nothing becomes negative, as it would in a
/// least-squares fit: a noisy part of an object would be there with either sign.
class OccluderMeans final : public ColumnSums {
 public:
  /// What is given outlives it.
  OccluderMeans(const FitMesh& mesh, const OccluderColumn& column)
      : mesh_(mesh), column_(column), rows_(mesh.slotCount()) {}

  void add(const SeenBlock& block) override;

  /// Ascending by group. A slot that no receiver is near has the mean of what lies around it, if anything is
  /// seen there.
  std::vector<OccluderSeen> around(std::uint32_t slot) const;

  void save(StateWriter& state) const override;
  void load(StateReader& state, const SeenCounts& counts) override;

 private:
  struct Row {
    float weight = 0.0f;  ///< of the receivers around
    std::vector<std::uint32_t> groups;
    std::vector<SeenOccluder> seen;  ///< parallel to groups, times weights
    std::vector<SeenWays> ways;      ///< the same, or empty: nothing sends light on

    std::size_t placeOf(std::uint32_t group);
  };

  void addReceiver(const SeenBlock& block, std::size_t index);
  SeenWays waysOf(const device::OccluderWaySums* sums) const;

  const FitMesh& mesh_;
  const OccluderColumn& column_;
  std::vector<Row> rows_;  ///< [slot]
};

}  // namespace prelight
