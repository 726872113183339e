#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "cast/column.h"
#include "device/kernel.h"

namespace prelight {

class SideSums;
class TexelColumn;

/// The rays of receivers, texel by texel, for projections that no small set of sums can feed. Receivers that
/// saw nothing but sky, or nothing of it, need no row. Where memory is short, every second receiver is left
/// out, then three of four, and so on, whatever they saw: those that stay represent them.
class TexelRows final : public ColumnSums {
 public:
  enum : std::uint32_t { open = 0xfffffffeu, closed = 0xffffffffu, missing = 0xfffffffdu };

  /// At most `capacity` rows are kept, of the column's codes.
  TexelRows(const TexelColumn& column, std::size_t capacity, std::uint32_t raysPerReceiver)
      : column_(column), capacity_(capacity), width_(raysPerReceiver) {}

  /// What receiver `i` has: open, closed, missing, or a row for codes().
  std::uint32_t rowOf(std::size_t i) const { return rows_[i]; }

  std::span<const std::uint32_t> codes(std::uint32_t row) const {
    return std::span(codes_).subspan(std::size_t{row} * width_, width_);
  }

  void add(const SeenBlock& block) override;
  void save(StateWriter& state) const override;
  void load(StateReader& state, const SeenCounts& counts) override;

 private:
  void addReceiver(std::span<const std::uint32_t> codes);
  void thin();
  void check(const StateReader& state, const SeenCounts& counts) const;

  const TexelColumn& column_;
  std::size_t capacity_;
  std::vector<std::uint32_t> rows_;   ///< [receiver]
  std::vector<std::uint32_t> codes_;  ///< [row][ray]
  std::uint32_t count_ = 0;           ///< of rows
  std::uint32_t width_;               ///< rays per receiver
  std::uint32_t stride_ = 1;          ///< receivers whose number it divides are kept
};

/// Where each ray of a receiver goes on a cube map, and how much of its light is blocked; see
/// host/techniques/haar/texel_kernels.cl. Only fronts have rows.
class TexelColumn final : public Column {
 public:
  /// Rays are coded on cube maps of that face size; about `bytes` of codes are kept.
  TexelColumn(int faceSize, std::uint64_t bytes) : faceSize_(faceSize), bytes_(bytes) {}

  int faceSize() const { return faceSize_; }

  /// Returns the rows of a side whose receivers have some.
  const TexelRows& rowsOn(const SideSums& side) const;

  bool castFrom(Side side) const override { return side == Side::Front; }
  void start(const CastBlock& block) override;
  void finish(const CastBlock& block, ColumnRows& rows) override { codes_.read(block, rows); }
  void loadBlock(StateReader& state, const CastTask& task, std::uint32_t receivers,
                 const ColumnRows& rows) override;
  std::unique_ptr<ColumnSums> makeSums(const SideShape& side) override;

 private:
  void allocate(const CastShape& shape) override;

  int faceSize_;
  std::uint64_t bytes_;
  DeviceRows<std::uint32_t> codes_;
  Kernel<Buffer<device::CastParameters>, std::uint32_t, Buffer<device::Ray>, Buffer<device::Hit>,
         Buffer<std::uint32_t>>
      code_;
};

}  // namespace prelight
