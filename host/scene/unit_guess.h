#pragma once

#include <optional>
#include <string>
#include <vector>

#include "prelight/compiled_scene.h"

namespace prelight {

/// A scale that makes metres, and of what.
struct UnitRemedy {
  double scale = 1.0;
  std::string where;  ///< "where its numbers are millimetres"
};

/// What a scene's unit of length may be where metres are not sure.
struct UnitGuess {
  std::string unit;  ///< "centimetres"; empty: nothing but the size speaks against metres
  std::string reason;
  std::optional<double> scale = {};       ///< to metres; none where no unit is likely
  std::vector<UnitRemedy> remedies = {};  ///< where `unit` is empty: what helps if metres are wrong
};

/// Longest edge of a scene's bounds, m.
double longestEdge(const CompiledScene& scene);

/// Nothing for a scene whose size is one of things, rooms, buildings or the land around them. `bends`: it has
/// skins or morph targets, as figures do, which are smaller, so that a large one says what its unit is. Of
/// other scenes the size alone says nothing: a landscape of a kilometre and a machine part of a metre in
/// millimetres have the same numbers.
std::optional<UnitGuess> guessUnit(const CompiledScene& scene, bool bends);

}  // namespace prelight
