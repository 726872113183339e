#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "base/state_file.h"
#include "cast/column.h"
#include "device/kernel.h"
#include "gpu/tracer.h"
#include "prelight/techniques.h"
#include "shared/cast_types.h"

namespace prelight {

/// Where rays end: nothing that obscures lies farther than where obscurance has faded out. 0: nowhere.
double reachOf(const OcclusionLimits& limits);

/// [triangle][3], orientedNormal of each.
std::vector<float> orientedNormals(const CompiledScene& scene);

/// [triangle], 1 where both sides are fronts, or light comes through from one to the other.
std::vector<std::uint8_t> twoSidedTriangles(const CompiledScene& scene);

/// Receivers per block, of that many rays each: what one round of launches takes.
std::uint32_t receiversPerBlock(const DeviceInfo& device, std::uint32_t raysPerReceiver);

struct CastOptions {
  std::uint32_t raysPerReceiver = 64;  ///< a power of two, 8 to 256
  OcclusionLimits limits;
  bool marksInside = false;  ///< tell which receivers of fronts lie inside objects
  std::span<const std::uint8_t> solids =
      {};                             ///< [triangle], read by the constructor alone: 1 where it is one
                                      ///< of the solids that receivers are told to lie inside; empty:
                                      ///< where rays meet nothing but backs of one-sided surfaces
  bool overlaps = false;              ///< two blocks may be under way, where the columns allow it
  const ShadowSets* sets = nullptr;   ///< nullptr: all see everything
  std::span<Tracer> setTracers = {};  ///< [set - 1]; must outlive the caster
};

/// Casts blocks of receivers: receivers -> rays -> hits -> rows of columns.
class Caster {
 public:
  /// The scene, the tracer and the columns, which are finished in the order in which they are given, outlive
  /// the caster.
  Caster(const CompiledScene& scene, Tracer& tracer, const CastOptions& options,
         std::vector<Column*> columns = {});
  Caster(const Caster&) = delete;
  Caster& operator=(const Caster&) = delete;

  const std::vector<Column*>& columns() const { return columns_; }

  /// Sets where rays end from the next block on: OcclusionLimits::farthest.
  void setFarthest(double farthest) { options_.limits.farthest = farthest; }

  /// Receivers per block at most: what one round of launches takes.
  std::uint32_t blockSize() const { return blockSize_; }

  /// Casts a block of receivers of one set of occluders.
  void cast(std::span<const device::Receiver> receivers, CastRows& rows, const CastTask& task = {}) {
    start(0, receivers, task);
    finish(0, rows);
  }

  /// Casts a block in two halves: start() queues the kernels, finish() waits for them. As many blocks as
  /// there are places may be under way, each in a place of its own.
  void start(std::size_t place, std::span<const device::Receiver> receivers, const CastTask& task = {});
  void finish(std::size_t place, CastRows& rows);
  std::size_t places() const { return blocks_.size(); }

  /// Returns whether rays of receivers are traced: for a column, or to mark receivers inside objects.
  bool traces(const CastTask& task) const;

  /// Frees all places but one, for what follows a cast: memory is at its peak then.
  void keepOnePlace() { blocks_.erase(blocks_.begin() + 1, blocks_.end()); }

  /// Draws the rays of receivers whose rows stand from `firstRow` on once more, without tracing them.
  CastBlockBuffers drawDirections(std::span<const device::Receiver> receivers, std::uint32_t firstRow);

  /// Rays that columns have cast so far besides those of the hemispheres and to lights.
  std::uint64_t furtherRays() const;

  std::uint32_t raysPerReceiver() const { return options_.raysPerReceiver; }
  DeviceContext& device() const { return device_; }

  /// Write and read what the columns keep besides their sums (Column::save).
  void save(StateWriter& state) const;
  void load(StateReader& state);

  /// Write and read the block that was finished last, which another process has cast.
  void saveBlock(StateWriter& state, const CastRows& rows, const CastTask& task,
                 std::uint32_t receivers) const;
  void loadBlock(StateReader& state, CastRows& rows, const CastTask& task, std::uint32_t receivers);

 private:
  /// A place: what the device has of a block under way.
  struct Block {
    DeviceLane lane;
    Buffer<device::CastParameters> parameters;
    Buffer<device::Receiver> receivers;
    Buffer<device::Ray> rays;
    Buffer<device::Hit> hits;
    Buffer<std::uint8_t> inside;
    std::uint32_t count = 0;  ///< receivers
    CastTask task;
    bool closest = false;                  ///< hits are
    std::vector<device::Receiver> placed;  ///< where they are marked inside objects
  };

  Block makeBlock(DeviceLane lane) const;
  CastBlock castBlock(const Block& block) const;
  Tracer& tracerOf(std::uint32_t set) const { return set == 0 ? tracer_ : options_.setTracers[set - 1]; }
  static bool takes(const Column& column, const CastTask& task) {
    return column.castFrom(task.side) && column.takes(task);
  }
  bool marksInside(const CastTask& task) const { return options_.marksInside && task.side == Side::Front; }
  bool needsClosest(const CastTask& task) const;
  device::CastParameters parametersOf(std::uint32_t receivers) const;
  static void place(Block& block, std::span<const device::Receiver> receivers,
                    const device::CastParameters& parameters);
  void generate(Block& block, std::span<const device::Receiver> receivers,
                const device::CastParameters& parameters);
  void trace(Block& block, std::span<const device::Receiver> receivers,
             const device::CastParameters& parameters);
  Buffer<float> geometricNormals();
  void markInside(Block& block);
  void readInside(Block& block, std::vector<std::uint8_t>& inside);

  const CompiledScene& scene_;
  Tracer& tracer_;
  DeviceContext& device_;
  CastOptions options_;
  std::vector<Column*> columns_;
  std::uint32_t blockSize_;
  std::vector<Block> blocks_;  ///< [place]
  Buffer<float> geometricNormals_;
  bool findsSolids_ = false;  ///< receivers inside are marked by a part of their rays
  Buffer<std::uint8_t> hides_;
  using Parameters = Buffer<device::CastParameters>;
  using Receivers = Buffer<device::Receiver>;
  using Rays = Buffer<device::Ray>;
  using Hits = Buffer<device::Hit>;
  Kernel<Parameters, Receivers, Rays> generate_;
  Kernel<Parameters, std::uint32_t, std::uint32_t, Receivers, Rays, Hits, Buffer<float>, Buffer<std::uint8_t>,
         Buffer<std::uint8_t>>
      insideMarks_;
};

}  // namespace prelight
