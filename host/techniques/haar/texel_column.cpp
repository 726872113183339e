#include "techniques/haar/texel_column.h"

#include <algorithm>
#include <bit>

#include "basis/cube_map.h"
#include "cast/side_sums.h"

namespace prelight {

/// Receivers that have a record.
void TexelRows::add(const SeenBlock& block) {
  const auto codes = block.rows.of(column_).of<std::uint32_t>();
  for (std::size_t i = 0; i < block.samples.size() && rows_.size() < SampleRecords::most; ++i)
    addReceiver(codes.subspan(i * width_, width_));
}

void TexelRows::addReceiver(std::span<const std::uint32_t> codes) {
  if (capacity_ == 0) return rows_.push_back(missing);
  while (count_ == capacity_ && rows_.size() % stride_ == 0) thin();
  if (rows_.size() % stride_ != 0) return rows_.push_back(missing);
  const auto blocked = [](std::uint32_t code) { return code & 255u; };
  if (std::all_of(codes.begin(), codes.end(), [&](auto code) { return blocked(code) == 0; }))
    return rows_.push_back(open);
  if (std::all_of(codes.begin(), codes.end(), [&](auto code) { return blocked(code) == 255; }))
    return rows_.push_back(closed);
  rows_.push_back(count_++);
  // Where it grows bit by bit, it is copied as often.
  if (codes_.capacity() == 0) codes_.reserve(capacity_ * width_);
  codes_.insert(codes_.end(), codes.begin(), codes.end());
}

void TexelRows::thin() {
  stride_ *= 2;
  count_ = 0;
  for (std::size_t i = 0; i < rows_.size(); ++i) {
    const bool kept = i % stride_ == 0;
    if (rows_[i] < missing && kept) {
      std::copy_n(codes_.begin() + static_cast<std::ptrdiff_t>(std::size_t{rows_[i]} * width_), width_,
                  codes_.begin() + static_cast<std::ptrdiff_t>(std::size_t{count_} * width_));
      rows_[i] = count_++;
    } else if (!kept) {
      rows_[i] = missing;
    }
  }
  codes_.resize(std::size_t{count_} * width_);
}

// Rows are renumbered where receivers are left out, and nowhere else.
void TexelRows::save(StateWriter& state) const {
  state.value(stride_);
  state.growing(rows_, rows_.size(), stride_);
  state.growing(codes_, codes_.size(), stride_);
  state.value(count_);
}

void TexelRows::load(StateReader& state, const SeenCounts& counts) {
  state.value(stride_);
  state.growing(rows_);
  state.growing(codes_);
  state.value(count_);
  check(state, counts);
}

void TexelRows::check(const StateReader& state, const SeenCounts& counts) const {
  state.require(rows_.size() == counts.recorded && std::has_single_bit(stride_));
  state.require(codes_.size() == std::size_t{count_} * width_);
  std::uint32_t next = 0;
  for (const std::uint32_t row : rows_)
    if (row < missing) state.require(row == next++);
  state.require(next == count_);
  const std::size_t texels = cubeTexelCount(column_.faceSize());
  for (const std::uint32_t code : codes_) state.require((code >> 8) < texels);
}

void TexelColumn::allocate(const CastShape& shape) {
  codes_ = DeviceRows<std::uint32_t>(shape, shape.raysPerReceiver);
  code_ = {shape.tracer.context(), "techniques/haar/texel_kernels.cl", {}, "codeTexels"};
}

void TexelColumn::start(const CastBlock& block) {
  code_.launch({block.receivers * codes_.width(), block.lane}, block.buffers.parameters,
               static_cast<std::uint32_t>(faceSize_), block.buffers.rays, block.buffers.hits,
               codes_.of(block));
}

void TexelColumn::loadBlock(StateReader& state, const CastTask& /*task*/, std::uint32_t receivers,
                            const ColumnRows& rows) {
  state.require(rows.records.empty() &&
                rows.rows.size() == receivers * codes_.width() * sizeof(std::uint32_t));
  for (const std::uint32_t code : rows.of<std::uint32_t>())
    state.require((code >> 8) < cubeTexelCount(faceSize_));
}

std::unique_ptr<ColumnSums> TexelColumn::makeSums(const SideShape& side) {
  const std::size_t capacity = bytes_ / (sizeof(std::uint32_t) * side.raysPerReceiver);
  return std::make_unique<TexelRows>(*this, capacity, side.raysPerReceiver);
}

const TexelRows& TexelColumn::rowsOn(const SideSums& side) const {
  return static_cast<const TexelRows&>(side.of(*this));
}

}  // namespace prelight
