#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "base/state_file.h"

namespace prelight {

/// The rays of receivers, texel by texel, for projections that no small set of sums can feed. Receivers that
/// saw nothing but sky, or nothing of it, need no row. Where memory is short, every second receiver is left
/// out, then three of four, and so on, whatever they saw: those that stay represent them.
class TexelRows {
 public:
  enum : std::uint32_t { open = 0xfffffffeu, closed = 0xffffffffu, missing = 0xfffffffdu };

  /// Adds a receiver: its rays as texel x 256 + blocked part of 255. At most `capacity` rows are kept.
  void add(std::span<const std::uint32_t> codes, std::size_t capacity);

  /// What receiver `i` has: open, closed, missing, or a row for codes().
  std::uint32_t rowOf(std::size_t i) const { return rows_[i]; }

  std::span<const std::uint32_t> codes(std::uint32_t row) const {
    return std::span(codes_).subspan(std::size_t{row} * width_, width_);
  }

  void save(StateWriter& state) const;
  void load(StateReader& state);

  /// Throws through `state` unless what was loaded is of `receivers`, with `rays` codes in a row, of cube
  /// maps of `texels`.
  void check(const StateReader& state, std::size_t receivers, std::uint32_t rays, std::size_t texels) const;

 private:
  void thin();

  std::vector<std::uint32_t> rows_;   ///< [receiver]
  std::vector<std::uint32_t> codes_;  ///< [row][ray]
  std::uint32_t count_ = 0;           ///< of rows
  std::uint32_t width_ = 0;           ///< rays a receiver
  std::uint32_t stride_ = 1;          ///< receivers whose number it divides are kept
};

}  // namespace prelight
