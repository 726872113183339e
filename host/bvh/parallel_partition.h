#pragma once

#include <algorithm>
#include <cstddef>
#include <span>
#include <vector>

#include "base/parallel.h"

namespace prelight {

/// Partitions in place like std::partition, on all cores: blocks are partitioned separately, then elements on
/// the wrong side are exchanged. The resulting order depends only on the elements. Returns how many go left.
template <typename T, typename GoesLeft>
std::size_t parallelPartition(std::span<T> items, const GoesLeft& goesLeft, std::size_t threads) {
  constexpr std::size_t grain = 1u << 15;
  const std::size_t blocks = (items.size() + grain - 1) / grain;
  std::vector<std::size_t> lefts(blocks);
  parallelRanges(
      items.size(), grain,
      [&](std::size_t begin, std::size_t end) {
        const auto first = items.begin() + static_cast<std::ptrdiff_t>(begin);
        const auto last = items.begin() + static_cast<std::ptrdiff_t>(end);
        lefts[begin / grain] = static_cast<std::size_t>(std::partition(first, last, goesLeft) - first);
      },
      threads);
  std::size_t leftTotal = 0;
  for (const std::size_t count : lefts) leftTotal += count;

  // Runs of elements that are on the wrong side of `leftTotal`.
  struct Run {
    std::size_t first, count;
  };
  std::vector<Run> wrongLeft, wrongRight;
  for (std::size_t b = 0; b < blocks; ++b) {
    const std::size_t begin = b * grain, middle = begin + lefts[b],
                      end = std::min(items.size(), begin + grain);
    if (middle < leftTotal && middle < end) wrongLeft.push_back({middle, std::min(end, leftTotal) - middle});
    if (middle > leftTotal && middle > begin) {
      const std::size_t from = std::max(begin, leftTotal);
      wrongRight.push_back({from, middle - from});
    }
  }
  struct Exchange {
    std::size_t a, b, count;
  };
  std::vector<Exchange> exchanges;
  for (std::size_t i = 0, j = 0; i < wrongLeft.size() && j < wrongRight.size();) {
    Run &a = wrongLeft[i], &b = wrongRight[j];
    const std::size_t count = std::min(a.count, b.count);
    exchanges.push_back({a.first, b.first, count});
    a = {a.first + count, a.count - count};
    b = {b.first + count, b.count - count};
    i += a.count == 0;
    j += b.count == 0;
  }
  parallelRanges(
      exchanges.size(), 1,
      [&](std::size_t begin, std::size_t end) {
        for (std::size_t e = begin; e < end; ++e)
          std::swap_ranges(items.begin() + static_cast<std::ptrdiff_t>(exchanges[e].a),
                           items.begin() + static_cast<std::ptrdiff_t>(exchanges[e].a + exchanges[e].count),
                           items.begin() + static_cast<std::ptrdiff_t>(exchanges[e].b));
      },
      threads);
  return leftTotal;
}

}  // namespace prelight
