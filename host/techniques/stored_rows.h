#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "cast/side_cast.h"
#include "cast/stored_transport.h"
#include "fit/normal_equations.h"
#include "prelight/progress.h"

namespace prelight {

/// Writes what rows [first, first + count) of stored transport are worth: [row][column].
using GatherRows = std::function<void(std::uint32_t first, std::uint32_t count, std::vector<float>& values)>;

/// Fits the slots to what is gathered through one side's stored rows, as often as is wanted: the equations
/// are made once.
class StoredRows {
 public:
  /// What is given outlives it.
  StoredRows(const StoredTransport& transport, const SideCast& side);

  /// Values of the slots, [slot][column], fitted to what `gather` makes of the rows, which are told apart by
  /// their number among the side's own; `most` at once. The device gathers while the host adds up those
  /// before.
  std::vector<float> fit(std::size_t columns, std::uint32_t most, const GatherRows& gather,
                         Progress& progress) const;

 private:
  void gatherAll(std::size_t columns, std::uint32_t most, const GatherRows& gather, std::vector<float>& right,
                 Progress& progress) const;
  void add(std::uint32_t first, std::span<const float> values, std::size_t columns,
           std::span<float> right) const;
  const VertexFit& samples() const { return part_ ? *part_ : side_.sums().fit(); }

  const StoredTransport& transport_;
  const SideCast& side_;
  std::optional<VertexFit> part_;  ///< of the rows that are stored, where those are not all
  NormalEquations equations_;
};

}  // namespace prelight
