#include "charts/mask_packing.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <numeric>

namespace prelight {

namespace {

// Cells of the bitmap in which places are searched.
constexpr std::size_t mostBitmapCells = std::size_t{1} << 20;
// Up to so many masks are packed several times, and the best packing is kept.
constexpr std::size_t fewMasks = 600;

/// A mask in 64-bit words, at the granularity of the bitmap.
struct BitMask {
  int width = 0;
  int height = 0;
  int words = 0;                    ///< per row
  std::vector<std::uint64_t> bits;  ///< [row][word], least significant bit first

  std::uint64_t word(int row, int k) const {
    return bits[static_cast<std::size_t>(row) * static_cast<std::size_t>(words) +
                static_cast<std::size_t>(k)];
  }
};

BitMask bitsOf(const ChartMask& mask, int grain) {
  BitMask result;
  result.width = (mask.width + grain - 1) / grain;
  result.height = (mask.height + grain - 1) / grain;
  result.words = (result.width + 63) / 64;
  result.bits.assign(static_cast<std::size_t>(result.words) * static_cast<std::size_t>(result.height), 0);
  for (int y = 0; y < mask.height; ++y)
    for (int x = 0; x < mask.width; ++x) {
      if (mask.cells[static_cast<std::size_t>(y) * static_cast<std::size_t>(mask.width) +
                     static_cast<std::size_t>(x)] == 0)
        continue;
      const int column = x / grain, row = y / grain;
      result.bits[static_cast<std::size_t>(row) * static_cast<std::size_t>(result.words) +
                  static_cast<std::size_t>(column / 64)] |= std::uint64_t{1} << (column % 64);
    }
  return result;
}

/// The atlas during packing; it grows downwards.
class Bitmap {
 public:
  explicit Bitmap(int width) : width_(width), words_(static_cast<std::size_t>(width) / 64 + 2) {}

  /// Returns the first free place at or below row `from`.
  glm::ivec2 find(const BitMask& mask, int from) {
    for (int y = from;; ++y) {
      while (rows() < y + mask.height) bits_.resize(bits_.size() + words_, 0);
      for (int x = 0; x + mask.width <= width_; ++x)
        if (isFree(mask, x, y)) return {x, y};
    }
  }

  void take(const BitMask& mask, const glm::ivec2& at) {
    for (int row = 0; row < mask.height; ++row)
      for (int k = 0; k < mask.words; ++k) {
        const std::uint64_t bits = mask.word(row, k);
        const auto x = static_cast<std::size_t>(at.x + 64 * k);
        std::uint64_t* to = &bits_[static_cast<std::size_t>(at.y + row) * words_ + x / 64];
        to[0] |= bits << (x % 64);
        if (x % 64 != 0) to[1] |= bits >> (64 - x % 64);
      }
    used_ = std::max(used_, at.y + mask.height);
  }

  int usedRows() const { return used_; }

 private:
  int rows() const { return static_cast<int>(bits_.size() / words_); }

  std::uint64_t window(int y, std::size_t x) const {
    const std::uint64_t* from = &bits_[static_cast<std::size_t>(y) * words_ + x / 64];
    return x % 64 == 0 ? from[0] : from[0] >> (x % 64) | from[1] << (64 - x % 64);
  }

  bool isFree(const BitMask& mask, int x, int y) const {
    for (int row = 0; row < mask.height; ++row)
      for (int k = 0; k < mask.words; ++k)
        if ((window(y + row, static_cast<std::size_t>(x + 64 * k)) & mask.word(row, k)) != 0) return false;
    return true;
  }

  int width_;
  std::size_t words_;  ///< per row, one more than its texels need
  std::vector<std::uint64_t> bits_;
  int used_ = 0;
};

/// Returns the size class of a mask: where no place was found for one, none of its class is tried again.
std::size_t classOf(const BitMask& mask) {
  const auto log = [](int n) { return static_cast<std::size_t>(std::bit_width(static_cast<unsigned>(n))); };
  return log(mask.width) * 32 + log(mask.height);
}

/// Returns nothing if the packing needs more than `mostRows` rows.
std::optional<MaskPacking> packInto(std::span<const BitMask> masks, std::span<const std::uint32_t> order,
                                    int width, std::int64_t mostRows) {
  Bitmap bitmap(width);
  MaskPacking packing{width, 0, std::vector<glm::ivec2>(masks.size())};
  std::array<int, 32 * 32> startRow{};
  for (const std::uint32_t i : order) {
    int& start = startRow[classOf(masks[i])];
    const glm::ivec2 at = bitmap.find(masks[i], start);
    start = at.y;
    bitmap.take(masks[i], at);
    if (bitmap.usedRows() > mostRows) return std::nullopt;
    packing.origins[i] = at;
  }
  packing.height = bitmap.usedRows();
  return packing;
}

std::vector<std::uint32_t> orderBy(std::span<const BitMask> masks, bool byHeight) {
  std::vector<std::uint32_t> order(masks.size());
  std::iota(order.begin(), order.end(), 0u);
  std::stable_sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
    const BitMask &m = masks[a], &n = masks[b];
    const auto area = [](const BitMask& mask) { return std::int64_t{mask.width} * mask.height; };
    if (byHeight) return m.height != n.height ? m.height > n.height : m.width > n.width;
    return area(m) != area(n) ? area(m) > area(n) : m.width > n.width;
  });
  return order;
}

}  // namespace

std::optional<MaskPacking> packMasks(std::span<const ChartMask> masks, int mostSide) {
  if (masks.empty()) return MaskPacking{1, 1, {}};
  std::size_t needed = 0;
  int widest = 1;
  for (const ChartMask& mask : masks) {
    needed +=
        mask.cells.size() - static_cast<std::size_t>(std::count(mask.cells.begin(), mask.cells.end(), 0));
    widest = std::max({widest, mask.width});
  }
  const auto most = static_cast<std::size_t>(mostSide);
  if (widest > mostSide || needed > most * most) return std::nullopt;
  int grain = 1;
  while (needed / static_cast<std::size_t>(grain * grain) > mostBitmapCells) grain *= 2;
  std::vector<BitMask> bits;
  bits.reserve(masks.size());
  double cells = 0.0;
  for (const ChartMask& mask : masks) {
    bits.push_back(bitsOf(mask, grain));
    for (const std::uint64_t word : bits.back().bits) cells += std::popcount(word);
  }
  const int least = (widest + grain - 1) / grain, limit = mostSide / grain;
  constexpr std::array<double, 8> widths = {1.05, 1.0, 1.02, 1.08, 1.12, 1.2, 1.3, 0.9};
  const std::size_t tries = masks.size() <= fewMasks ? widths.size() : 1;
  std::optional<MaskPacking> best;
  for (std::size_t i = 0; i < tries; ++i)
    for (const bool byHeight : {false, true}) {
      if (byHeight && tries == 1) continue;
      const int width = std::clamp(static_cast<int>(std::ceil(std::sqrt(cells) * widths[i])), least,
                                   std::max(least, limit));
      // Packings with as many texels as the best so far are given up early.
      const std::int64_t better = best ? (std::int64_t{best->width} * best->height - 1) / width : limit;
      std::optional<MaskPacking> packing =
          packInto(bits, orderBy(bits, byHeight), width, std::min<std::int64_t>(better, limit));
      if (packing) best = std::move(packing);
    }
  if (!best && tries == 1) best = packInto(bits, orderBy(bits, true), limit, limit);
  if (!best || best->height > limit) return std::nullopt;
  best->width *= grain;
  best->height *= grain;
  for (glm::ivec2& origin : best->origins) origin *= grain;
  return best;
}

}  // namespace prelight
