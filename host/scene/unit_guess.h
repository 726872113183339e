#pragma once

#include <optional>
#include <string>

#include "prelight/compiled_scene.h"

namespace prelight {

/// What a scene's unit of length is taken to be where metres are unlikely.
struct UnitGuess {
  std::string unit;  ///< "millimetres"
  std::string reason;
  std::optional<double> scale = {};  ///< to metres; none where no --scale makes a likely size of it
};

/// Longest edge of a scene's bounds, m.
double longestEdge(const CompiledScene& scene);

/// Nothing for a scene whose size is one of things, rooms, buildings or the land around them. `bends`: it has
/// skins or morph targets, as figures do, which are smaller.
std::optional<UnitGuess> guessUnit(const CompiledScene& scene, bool bends);

}  // namespace prelight
