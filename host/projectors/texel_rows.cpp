#include "projectors/texel_rows.h"

#include <algorithm>
#include <bit>

namespace prelight {

void TexelRows::add(std::span<const std::uint32_t> codes, std::size_t capacity) {
  while (count_ == capacity && rows_.size() % stride_ == 0 && capacity > 0) thin();
  if (rows_.size() % stride_ != 0) return rows_.push_back(missing);
  const auto blocked = [](std::uint32_t code) { return code & 255u; };
  if (std::all_of(codes.begin(), codes.end(), [&](auto code) { return blocked(code) == 0; }))
    return rows_.push_back(open);
  if (std::all_of(codes.begin(), codes.end(), [&](auto code) { return blocked(code) == 255; }))
    return rows_.push_back(closed);
  rows_.push_back(count_++);
  width_ = static_cast<std::uint32_t>(codes.size());
  // Where it grows bit by bit, it is copied as often.
  if (codes_.capacity() == 0) codes_.reserve(capacity * width_);
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
  state.value(width_);
}

void TexelRows::load(StateReader& state) {
  state.value(stride_);
  state.growing(rows_);
  state.growing(codes_);
  state.value(count_);
  state.value(width_);
}

void TexelRows::check(const StateReader& state, std::size_t receivers, std::uint32_t rays,
                      std::size_t texels) const {
  state.require(rows_.size() == receivers && (count_ == 0 || width_ == rays) && std::has_single_bit(stride_));
  state.require(codes_.size() == std::size_t{count_} * width_);
  std::uint32_t next = 0;
  for (const std::uint32_t row : rows_)
    if (row < missing) state.require(row == next++);
  state.require(next == count_);
  for (const std::uint32_t code : codes_) state.require((code >> 8) < texels);
}

}  // namespace prelight
