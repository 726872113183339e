#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "cast/cast_block.h"
#include "cast/occluder_ways.h"
#include "gpu/tracer.h"
#include "occluders/occluder_groups.h"
#include "shared/occluder_types.h"

namespace prelight {

/// What a block's receivers see of occluders: records of receiver i are spans[i].first and the count - 1
/// after it.
struct OccluderValues {
  struct Span {
    std::uint32_t first = 0;
    std::uint32_t count = 0;
  };
  std::vector<Span> spans;                        ///< [receiver]
  std::vector<device::OccluderSums> sums;         ///< [record]
  std::vector<device::OccluderWaySums> mirrored;  ///< [record], or empty: nothing is shiny
  std::vector<device::OccluderWaySums> through;   ///< [record], or empty: nothing is glass
};

/// Aggregates a block's hits by occluder (Sherif 2013, 7.2), with the rays that follow what shiny and
/// transmissive surfaces do with light.
class OccluderCaster {
 public:
  /// The block has at most `blockSize` receivers of `raysPerReceiver` rays. geometricNormals:
  /// orientedNormals().
  OccluderCaster(const CompiledScene& scene, const OccluderGroups& groups, Tracer& tracer,
                 const Buffer<float>& geometricNormals, std::uint32_t blockSize,
                 std::uint32_t raysPerReceiver);

  /// AO of every vertex, in [0,1]: it damps the normals of what sends light. Nothing is cast before.
  void setAccessibility(const CompiledScene& scene, std::span<const float> accessibility);

  /// `block` holds closest hits; `tracer` is that of the receivers' set of occluders.
  void cast(const CastBlockBuffers& block, std::uint32_t receivers, Tracer& tracer, OccluderValues& values);

  /// Rays cast so far besides the block's own.
  std::uint64_t rays() const { return ways_ ? ways_->rays() : 0; }

 private:
  void aggregate(const CastBlockBuffers& block, std::uint32_t receivers);

  DeviceScene scene_;  ///< with what occluders are told apart by
  DeviceContext& device_;
  std::uint32_t raysPerReceiver_;
  std::optional<OccluderWays> ways_;
  Buffer<float> geometricNormals_;
  Buffer<OccluderValues::Span> spans_;  ///< the number of all records, then those of receivers
  Buffer<device::OccluderSums> sums_;
  Buffer<device::OccluderWay> noWays_;
  Buffer<device::Hit> noHits_;
  Buffer<device::OccluderWaySums> waySums_;  ///< [record][PRELIGHT_WAYS]
  Kernel<Buffer<device::CastParameters>, Buffer<device::SceneLayout>, Buffer<device::SurfaceLine>,
         Buffer<device::OccluderLine>, Buffer<float>, Buffer<device::Ray>, Buffer<device::Hit>,
         Buffer<device::OccluderWay>, Buffer<device::Hit>, Buffer<OccluderValues::Span>,
         Buffer<device::OccluderSums>, Buffer<device::OccluderWaySums>>
      kernel_;
};

}  // namespace prelight
