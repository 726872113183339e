#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "io/state_file.h"

namespace prelight {

/// The rays of receivers, texel by texel, for projections that no small set of sums can feed. Receivers that
/// saw nothing but sky, or nothing of it, need no row.
class TexelRows {
 public:
  enum : std::uint32_t { open = 0xfffffffeu, closed = 0xffffffffu, missing = 0xfffffffdu };

  /// Adds a receiver: its rays as texel x 256 + blocked part of 255. Beyond `capacity` rows, mixed ones are
  /// missing.
  void add(std::span<const std::uint32_t> codes, std::size_t capacity) {
    std::uint32_t least = 255, most = 0;
    for (const std::uint32_t code : codes) {
      least = least < (code & 255u) ? least : code & 255u;
      most = most > (code & 255u) ? most : code & 255u;
    }
    if (most == 0 || least == 255) {
      rows_.push_back(most == 0 ? open : closed);
    } else if (count_ == capacity) {
      rows_.push_back(missing);
    } else {
      rows_.push_back(count_++);
      width_ = static_cast<std::uint32_t>(codes.size());
      codes_.insert(codes_.end(), codes.begin(), codes.end());
    }
  }

  /// Of receiver `i`: open, closed, missing, or a row for codes().
  std::uint32_t rowOf(std::size_t i) const { return rows_[i]; }

  std::span<const std::uint32_t> codes(std::uint32_t row) const {
    return std::span(codes_).subspan(std::size_t{row} * width_, width_);
  }

  void save(StateWriter& state) const {
    state.values(rows_);
    state.values(codes_);
    state.value(count_);
    state.value(width_);
  }

  void load(StateReader& state) {
    state.values(rows_);
    state.values(codes_);
    state.value(count_);
    state.value(width_);
  }

 private:
  std::vector<std::uint32_t> rows_;   ///< [receiver]
  std::vector<std::uint32_t> codes_;  ///< [row][ray]
  std::uint32_t count_ = 0;
  std::uint32_t width_ = 0;  ///< rays a receiver
};

}  // namespace prelight
