#pragma once

#include <span>
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

/// Options of techniques in the order in which help lists them.
std::span<const Option<BakeRequest>> techniqueOptions();

/// Throws Error when something in the bake does not fit the scene or cannot be drawn.
void checkBake(const Bake& bake, const CompiledScene& scene);

/// Moves what a bake holds for pictures into another bake.
void takeBake(Bake& into, Bake&& from);

/// Asks for what comes with the transfer that a request has, as `asked` does.
void addParts(BakeRequest& request, const BakeRequest& asked);

}  // namespace prelight
