#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "cast/caster.h"
#include "prelight/progress.h"
#include "projectors/side_cast.h"

namespace prelight {

/// Writes what rows [first, first + count) of a caster's stored senders are worth: [row][column].
using GatherRows =
    std::function<void(std::uint32_t first, std::uint32_t count, std::vector<float>& values)>;

/// Values of the slots, [slot][column], fitted to what `gather` makes of a side's stored rows, which are told
/// apart by their number among the side's own. The device gathers while the host adds up the block before.
std::vector<float> fitStoredRows(const Caster& caster, const SideCast& side, std::size_t columns,
                                 const GatherRows& gather, Progress& progress);

}  // namespace prelight
