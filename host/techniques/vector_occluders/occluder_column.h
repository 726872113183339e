#pragma once

#include <cstdint>
#include <optional>

#include "cast/column.h"
#include "device/kernel.h"
#include "occluders/occluder_tree.h"
#include "shared/occluder_types.h"
#include "techniques/vector_occluders/occluder_ways.h"

namespace prelight {

class OccluderMeans;
class SideSums;

/// A receiver's records among those of its block.
struct RecordSpan {
  std::uint32_t first = 0;
  std::uint32_t count = 0;
};

/// Sums over the rays of a receiver that meet the same occluder (Sherif 2013, 7.2), with rays that follow
/// light by way of shiny and transmissive surfaces. A receiver's row is a span of records, of which the
/// device hands out as many as the receiver sees occluders. Only fronts have rows, and only once
/// accessibility is known, which damps the normals of what sends light (7.2.4).
class OccluderColumn final : public Column {
 public:
  /// The groups outlive it.
  explicit OccluderColumn(const OccluderGroups& groups) : groups_(groups) {}

  enum : std::size_t {
    sums,
    ways
  };  ///< arrays of records: device::OccluderSums, and, where the column has
      ///< ways, PRELIGHT_WAYS device::OccluderWaySums each

  const OccluderGroups& groups() const { return groups_; }
  bool hasMirrors() const { return ways_ && ways_->hasMirrors(); }
  bool hasGlass() const { return ways_ && ways_->hasGlass(); }

  /// Returns the means of a side whose receivers have rows.
  const OccluderMeans& meansOn(const SideSums& side) const;

  ColumnNeeds needs() const override { return {.closestHits = true, .ownRays = true, .accessibility = true}; }
  bool castFrom(Side side) const override { return side == Side::Front; }
  bool takes(const CastTask& /*task*/) const override { return knowsAccessibility_; }
  void finish(const CastBlock& block, ColumnRows& rows) override;
  void setAccessibility(const CompiledScene& scene, std::span<const float> accessibility) override;
  std::uint64_t rays() const override { return earlierRays_ + (ways_ ? ways_->rays() : 0); }
  std::unique_ptr<ColumnSums> makeSums(const SideShape& side) override;
  void save(StateWriter& state) const override { state.value(rays()); }
  void load(StateReader& state) override { state.value(earlierRays_); }
  void saveBlock(StateWriter& state, const CastTask& task, std::uint32_t receivers) override;
  void loadBlock(StateReader& state, const CastTask& task, std::uint32_t receivers,
                 const ColumnRows& rows) override;

 private:
  void allocate(const CastShape& shape) override;
  void aggregate(const CastBlock& block);

  const OccluderGroups& groups_;
  bool knowsAccessibility_ = false;
  std::uint64_t earlierRays_ = 0;  ///< of runs that load() goes on with, and of blocks of other processes
  GrownCount toldRays_;
  std::uint32_t raysPerReceiver_ = 0;
  std::optional<DeviceScene> scene_;  ///< with what occluders are told apart by
  std::optional<OccluderWays> ways_;
  Buffer<float> geometricNormals_;
  Buffer<RecordSpan> spans_;  ///< the number of all records, then those of receivers
  Buffer<device::OccluderSums> sums_;
  Buffer<device::OccluderWay> noWays_;
  Buffer<device::Hit> noHits_;
  Buffer<device::OccluderWaySums> waySums_;  ///< [record][PRELIGHT_WAYS]
  Kernel<Buffer<device::CastParameters>, Buffer<device::SceneLayout>, Buffer<device::SurfaceLine>,
         Buffer<device::OccluderLine>, Buffer<float>, Buffer<device::Ray>, Buffer<device::Hit>,
         Buffer<device::OccluderWay>, Buffer<device::Hit>, Buffer<RecordSpan>, Buffer<device::OccluderSums>,
         Buffer<device::OccluderWaySums>>
      kernel_;
};

}  // namespace prelight
