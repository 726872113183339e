#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "base/state_file.h"
#include "device/buffer.h"
#include "device/context.h"
#include "gpu/tracer.h"
#include "plan/shadow_sets.h"
#include "prelight/compiled_scene.h"
#include "receivers/fit_mesh.h"
#include "receivers/surface_sampler.h"
#include "shared/cast_types.h"
#include "shared/ray_types.h"

namespace prelight {

/// Device buffers of the block that is being cast.
struct CastBlockBuffers {
  const Buffer<device::CastParameters>& parameters;
  const Buffer<device::Receiver>& receivers;
  const Buffer<device::Ray>& rays;
  const Buffer<device::Hit>& hits;  ///< the closest ones where those who read them need that
};

class Column;

/// Properties that all receivers of a block share.
struct CastTask {
  Side side = Side::Front;                     ///< side of the surface that the receivers look from
  std::uint32_t set = 0;                       ///< number of their set of occluders, see ShadowSets
  std::optional<std::uint32_t> firstRow = {};  ///< row of the block's first receiver in columns that keep
                                               ///< their rows on the device; empty: the block is not kept
};

/// A block of receivers on the device, whose rays have been traced.
struct CastBlock {
  CastBlockBuffers buffers;
  std::uint32_t receivers;
  CastTask task;
  Tracer& tracer;  ///< of the task's set
  DeviceLane lane;
};

/// Sizes by which a column allocates memory on the device, and the scene.
struct CastShape {
  const CompiledScene& scene;
  Tracer& tracer;
  const ShadowSets* sets;   ///< nullptr: all receivers see everything
  std::uint32_t blockSize;  ///< receivers per block, at most
  std::uint32_t raysPerReceiver;
  std::size_t lanes;                                ///< blocks that are under way at once
  std::function<Buffer<float>()> geometricNormals;  ///< returns orientedNormals() on the device
};

/// Demands of a column on the cast.
struct ColumnNeeds {
  bool closestHits = false;    ///< any hit of a ray does not do
  bool ownRays = false;        ///< finish() traces rays through buffers of one block: blocks do not overlap
  bool blockedRays = false;    ///< receivers all of whose rays end on surfaces are not thinned out
  bool accessibility = false;  ///< setAccessibility() is called between passes
  bool rays = true;            ///< the block's rays are traced
};

/// A block's rows of a column, in the host's memory. They are plain bytes: where they come from does not
/// matter to who adds them up.
struct ColumnRows {
  bool cast = false;                            ///< the column takes part in the block
  std::vector<std::byte> rows;                  ///< [receiver], of a size that the column knows
  std::vector<std::vector<std::byte>> records;  ///< [array][record], where rows say which records are theirs

  template <typename T>
  std::span<const T> of() const {
    return elements<T>(rows);
  }
  template <typename T>
  std::span<const T> recordsOf(std::size_t array) const {
    return elements<T>(records[array]);
  }

  /// Copies elements of a buffer, and waits for the kernels that write them.
  template <typename T>
  static void read(const Buffer<T>& buffer, std::size_t first, std::size_t count,
                   std::vector<std::byte>& bytes) {
    bytes.resize(count * sizeof(T));
    buffer.read(std::span(reinterpret_cast<T*>(bytes.data()), count), first);
  }

 private:
  template <typename T>
  static std::span<const T> elements(const std::vector<std::byte>& bytes) {
    return {reinterpret_cast<const T*>(bytes.data()), bytes.size() / sizeof(T)};
  }
};

/// Results of casting a block.
struct CastRows {
  std::vector<ColumnRows> columns;   ///< parallel to the caster's
  std::vector<std::uint8_t> inside;  ///< [receiver], 1: inside an object; or empty

  const ColumnRows& of(const Column& column) const;
};

/// Receivers that were cast together, and what they saw.
struct SeenBlock {
  std::vector<SurfaceSample> samples;
  std::vector<device::Receiver> receivers;  ///< parallel to samples
  CastRows rows;
  CastTask task;
  std::uint32_t group = 0;  ///< of the error estimate, below errorGroups
};

/// A side of the surface, to whose vertices columns are fitted.
struct SideShape {
  const CompiledScene& scene;
  const FitMesh& mesh;
  Side side;
  std::uint32_t raysPerReceiver;
  const std::vector<double>* areas;  ///< [triangle], what its samples weigh together in a fit; nullptr: each
                                     ///< sample weighs what it says
};

/// How many receivers a side has cast from.
struct SeenCounts {
  std::uint64_t receivers = 0;
  std::uint64_t recorded = 0;  ///< the first of them, which have a record (SampleRecords)
  std::uint32_t stored = 0;    ///< of those, the first, whose rows stay on the device
};

/// Running sums of a column over the receivers of one side of the surface.
class ColumnSums {
 public:
  virtual ~ColumnSums() = default;

  /// Adds the column's rows of a block. The result depends on the order of blocks.
  virtual void add(const SeenBlock& block) = 0;

  /// Limits the fit to the slots marked 1, [slot].
  virtual void extendTo(const std::vector<std::uint8_t>& /*slots*/) {}

  /// Takes the weight that samples inside objects have lost, [triangle] (VertexFit::leaveOut).
  virtual void leaveOut(const std::shared_ptr<const std::vector<float>>& /*unseen*/) {}

  /// Moves the sums to a file, and back before further blocks are added.
  virtual void park() {}
  virtual void fetch() {}

  virtual void save(StateWriter& state) const = 0;

  /// Reads what save() wrote after so many receivers. Throws InputError where the state does not fit them.
  virtual void load(StateReader& state, const SeenCounts& counts) = 0;
};

/// One quantity that the rays of a receiver yield, as a row per receiver. A column knows its kernels, how its
/// rows come to the host, and what the rows of a side are summed up to. The cast runs columns and does not
/// know what they mean. A column belongs to one caster. Where a task has a firstRow, rows may stay on the
/// device from there on, so that a range of rows is a slice of the receivers.
class Column {
 public:
  virtual ~Column() = default;

  /// Called once, by the caster, before anything is cast.
  void prepare(std::size_t index, const CastShape& shape) {
    index_ = index;
    allocate(shape);
  }

  /// Place among the caster's columns.
  std::size_t index() const { return index_; }

  virtual ColumnNeeds needs() const { return {}; }

  /// Receivers that may be cast at once, of the `usual` number.
  virtual std::uint32_t receiversAtOnce(DeviceKind /*kind*/, std::uint32_t usual) const { return usual; }

  /// Return whether receivers on a side have rows in this column, and whether a block's receivers do.
  virtual bool castFrom(Side /*side*/) const { return true; }
  virtual bool takes(const CastTask& /*task*/) const { return true; }

  /// Sets what the column's kernels need in a block's parameters, before its rays are traced.
  virtual void addParameters(const CastTask& /*task*/, DeviceLane /*lane*/,
                             device::CastParameters& /*parameters*/) {}

  /// Queues the column's kernels for a block and does not wait for them.
  virtual void start(const CastBlock& /*block*/) {}

  /// Reads the rows of a block back. A column with rays of its own casts them here. The caster finishes its
  /// columns in order.
  virtual void finish(const CastBlock& /*block*/, ColumnRows& /*rows*/) {}

  /// Tells the column the accessibility of every vertex as it is known so far, [vertex], in [0,1].
  virtual void setAccessibility(const CompiledScene& /*scene*/, std::span<const float> /*accessibility*/) {}

  /// Returns how many rays of its own the column has cast, those of earlier runs included.
  virtual std::uint64_t rays() const { return 0; }

  /// Returns empty sums for a side whose receivers have rows; nullptr: the rows are not summed up.
  virtual std::unique_ptr<ColumnSums> makeSums(const SideShape& /*side*/) { return nullptr; }

  /// Writes and reads what a resumed bake needs besides the sums: counters, and rows that stay on the device.
  virtual void save(StateWriter& /*state*/) const {}
  virtual void load(StateReader& /*state*/) {}

  /// Writes what a block that was finished last has left here besides its rows, for another process; reads
  /// it there, and requires of the block's rows what finish() gives them: their size, and values that may be
  /// added up.
  virtual void saveBlock(StateWriter& /*state*/, const CastTask& /*task*/, std::uint32_t /*receivers*/) {}
  virtual void loadBlock(StateReader& state, const CastTask& /*task*/, std::uint32_t /*receivers*/,
                         const ColumnRows& rows) {
    state.require(rows.rows.empty() && rows.records.empty());
  }

 private:
  virtual void allocate(const CastShape& /*shape*/) {}

  std::size_t index_ = 0;
};

/// A number that only grows, told by what it has grown.
class GrownCount {
 public:
  std::uint64_t growth(std::uint64_t now) { return now - std::exchange(told_, now); }

 private:
  std::uint64_t told_ = 0;
};

inline const ColumnRows& CastRows::of(const Column& column) const { return columns[column.index()]; }

/// Rows that kernels write, [receiver][width], of each block under way.
template <typename T>
class DeviceRows {
 public:
  DeviceRows() = default;
  DeviceRows(const CastShape& shape, std::size_t width) : width_(width) {
    for (std::size_t lane = 0; lane < shape.lanes; ++lane)
      buffers_.emplace_back(shape.tracer.context(), shape.blockSize * width, DeviceLane{lane});
  }

  std::size_t width() const { return width_; }
  Buffer<T>& of(const CastBlock& block) { return buffers_[block.lane.number]; }

  void read(const CastBlock& block, ColumnRows& rows) const {
    ColumnRows::read(buffers_[block.lane.number], 0, block.receivers * width_, rows.rows);
  }

 private:
  std::size_t width_ = 0;
  std::vector<Buffer<T>> buffers_;  ///< [lane number]
};

}  // namespace prelight
