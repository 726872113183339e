#pragma once

#include <cstdint>

#include "plot/drawing.h"
#include "prelight/bake.h"

namespace prelight::plot {

/// Returns the baked transfer of a vertex as a function of direction, as a balloon and as a map: SH or CH,
/// else Haar wavelets as a map alone. Where colours differ, the mean of the channels. Throws UsageError if
/// the bake has none of these or not so many vertices.
Drawing plotTransfer(const Bake& bake, std::uint32_t vertex);

}  // namespace prelight::plot
