#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "base/spill_file.h"
#include "cast/column.h"
#include "cast/told_marks.h"
#include "device/buffer.h"
#include "device/kernel.h"
#include "shared/cast_types.h"
#include "shared/specular_types.h"

namespace prelight {

/// Rows of senders, one a receiver, [row][ray]. The first of them stay in the device's memory, those that it
/// was given no room for lie in a file.
class SenderRows {
 public:
  /// At most `blockRows` rows are stored or read at once; as many in memory as `inMemory`. Each of `lanes`
  /// lanes has rows of its own on their way to the file.
  SenderRows(DeviceContext& device, std::uint32_t raysPerRow, std::uint32_t inMemory, std::uint32_t blockRows,
             std::size_t lanes = 1);

  /// Rows as a kernel finds them.
  struct Place {
    Buffer<device::Sender>& buffer;
    std::uint32_t firstRow;
  };

  /// Where a kernel in `lane` puts rows [first, first + count); once it is through, they are kept with
  /// keep().
  Place roomFor(std::uint32_t first, std::uint32_t count, DeviceLane lane = {}) {
    return inMemory(first, count) ? Place{memory_, first} : Place{blocks_[lane.number], 0};
  }
  void keep(std::uint32_t first, std::uint32_t count, DeviceLane lane = {});

  /// Whether rows stay where a kernel puts them: keep() has nothing to do.
  bool inMemory(std::uint32_t first, std::uint32_t count) const { return first + count <= inMemory_; }

  /// Where a kernel finds rows [first, first + count), until the next call.
  Place rows(std::uint32_t first, std::uint32_t count);

  /// Rows from `first` on, as many as the span holds.
  void read(std::uint32_t first, std::span<device::Sender> senders) const;
  void write(std::uint32_t first, std::span<const device::Sender> senders);

 private:
  std::size_t sendersInMemory(std::uint32_t first, std::size_t senders) const;

  std::uint32_t raysPerRow_;
  std::uint32_t inMemory_;
  Buffer<device::Sender> memory_;
  std::vector<Buffer<device::Sender>> blocks_;  ///< [lane], rows on their way to the file; back by the first
  std::vector<device::Sender> host_;
  std::optional<SpillFile> file_;  ///< made when it is needed; a row stands where it would if all were in it
};

class Caster;
class SpecularColumn;

/// Values of a vertex's transfer that a bounce carries at once. Results are the same whatever their number.
constexpr std::uint32_t widestPart = 16;

/// Returns how many of them where memory is short, and where it is not.
constexpr std::uint32_t partValuesOf(bool memoryIsShort) { return memoryIsShort ? 8 : widestPart; }

/// Sizes of stored transport.
struct TransportShape {
  std::uint32_t rows = 0;                 ///< that may be kept
  std::uint32_t rowsInMemory = 0;         ///< of them; further ones lie in a file
  std::size_t columns = 0;                ///< values per channel that bounces carry
  std::uint32_t partValues = widestPart;  ///< of the values that they carry at once, 8 or 16
};

/// A part of the values of each vertex's transfer, [3][columns]: partValues of them from firstValue on. In
/// the transfer on the device the part begins at vertex firstPlace, [vertex][partValues].
struct TransferPart {
  std::uint32_t firstValue = 0;
  std::uint32_t firstPlace = 0;
};

/// Rows of senders: for each ray of a receiver the surface that it meets, which sends light along it. Bounces
/// read the rows again and again instead of casting, so that they stay on the device, or in a file.
class StoredTransport final : public Column {
 public:
  /// `followed`: rays that meet mirrors and glass have what is seen by way of those; it comes before among
  /// the caster's columns. nullptr: they end there.
  explicit StoredTransport(const TransportShape& shape, const SpecularColumn* followed = nullptr)
      : shape_(shape), followed_(followed) {}

  ColumnNeeds needs() const override { return {.closestHits = true, .blockedRays = true}; }
  bool takes(const CastTask& task) const override { return task.firstRow.has_value(); }
  void addParameters(const CastTask& task, DeviceLane lane, device::CastParameters& parameters) override;
  void start(const CastBlock& block) override;
  void finish(const CastBlock& block, ColumnRows& rows) override;
  void save(StateWriter& state) const override;
  void load(StateReader& state) override;

  /// The marks of backs, which decide what is cast from, are not among what save() writes.
  void saveMarks(StateWriter& state) const { state.values(backMarks()); }
  void loadMarks(StateReader& state);
  void saveBlock(StateWriter& state, const CastTask& task, std::uint32_t receivers) override;
  void loadBlock(StateReader& state, const CastTask& task, std::uint32_t receivers,
                 const ColumnRows& rows) override;

  /// Summary of the rows that load() has read.
  struct Loaded {
    std::uint32_t rows = 0;
    bool fromBacks = false;  ///< some rows have senders that are backs
    bool marked = false;     ///< some triangle's back was hit
  };
  const Loaded& loaded() const { return loaded_; }

  std::uint32_t capacity() const { return shape_.rows; }
  std::uint32_t rowsInMemory() const { return shape_.rowsInMemory; }
  std::uint32_t partValues() const { return shape_.partValues; }

  /// Receivers that were cast at once, at most.
  std::uint32_t blockSize() const { return blockSize_; }

  /// [triangle], 1 where a stored ray hit a back.
  std::vector<std::uint8_t> backMarks() const { return marks_.read(); }

  /// Transfer that gathering reads, of vertices, then of their backs. A part of it, from value `first` on,
  /// into room for all.
  void setTransfer(std::span<const float> transfer, std::size_t first = 0);
  void resizeTransfer(std::size_t values);
  std::vector<float> readTransfer() const { return transfer_.read(); }

  /// Rows that gather() takes at most: several blocks, for a row is far less work than its rays were.
  std::uint32_t rowsPerGather() const { return 4 * blockSize_; }

  /// Mean over each stored row's rays of albedo x transfer, for rows [first, first + count), and for a part
  /// of a vertex's values [3][columns]: [row][partValues].
  void gather(std::uint32_t first, std::uint32_t count, const TransferPart& part, std::vector<float>& values);

  /// Gathers into transfer matrices: mean of Y_i(direction) x albedo x transfer, [row][i][3][columns] with i
  /// below order^2. `receivers` are those of the rows from `first` on, at most a block, whose directions the
  /// caster draws once more; the transfer is [vertex][3][columns], `columns` at most 8.
  void gatherGlossy(Caster& caster, std::span<const device::Receiver> receivers, std::uint32_t first,
                    int order, std::size_t columns, std::vector<float>& values);

 private:
  void allocate(const CastShape& shape) override;
  void requireSenders(const StateReader& state, std::span<const device::Sender> senders);
  BuildOptions buildOptions(std::size_t columns) const;

  TransportShape shape_;
  const SpecularColumn* followed_;
  DeviceContext* device_ = nullptr;  ///< as are scene_ and tracer_, of the caster
  const Tracer* tracer_ = nullptr;
  std::uint32_t vertexCount_ = 0;
  bool translucent_ = false;
  std::uint32_t blockSize_ = 0;
  std::uint32_t raysPerReceiver_ = 0;
  std::uint32_t stored_ = 0;  ///< rows
  Loaded loaded_;
  Buffer<float> geometricNormals_;
  std::optional<SenderRows> senders_;
  Buffer<std::uint8_t> marks_;
  ToldMarks toldMarks_;
  Buffer<float> transfer_;
  Buffer<device::CastParameters> gatherParameters_;
  Buffer<float> gatheredValues_;
  Buffer<float> glossyTable_, glossyValues_;
  using Parameters = Buffer<device::CastParameters>;
  using Layout = Buffer<device::SceneLayout>;
  using Surface = Buffer<device::SurfaceLine>;
  using Receivers = Buffer<device::Receiver>;
  using Senders = Buffer<device::Sender>;
  using Floats = Buffer<float>;
  using Marks = Buffer<std::uint8_t>;
  Kernel<Parameters, Layout, Surface, Floats, Receivers, Buffer<device::Ray>, Buffer<device::Hit>, Senders,
         Marks>
      store_;
  Kernel<Parameters, Layout, Surface, Floats, Receivers, Buffer<device::SpecularEnd>, Senders, Marks>
      storeFollowed_;
  Kernel<Parameters, std::uint32_t, std::uint32_t, Senders, Floats, Floats> gather_;
  Kernel<Parameters, Floats, Buffer<device::Ray>, Senders, Floats, Floats> glossy_;
};

}  // namespace prelight
