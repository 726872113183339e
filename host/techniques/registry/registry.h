#pragma once

#include <vector>

#include "techniques/technique.h"

namespace prelight {

/// All techniques in their one order: that of passes in a plan, of projectors in a bake, of members in a
/// file, of lines in a report. A technique that reads what another one has baked comes after it.
const std::vector<Technique>& techniques();

/// Describes every technique of a bake of `vertices` vertices.
std::vector<BakedSummary> summariesOf(const Bake& bake, std::size_t vertices);

/// Returns the numbers of every technique of a bake that can be compared with those of another bake.
std::vector<BakedArray> arraysOf(const Bake& bake);

}  // namespace prelight
