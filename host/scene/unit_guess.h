#pragma once

#include <optional>
#include <string>
#include <vector>

#include "prelight/compiled_scene.h"

namespace prelight {

/// A scale to metres, and when to use it.
struct UnitRemedy {
  double scale = 1.0;
  std::string where;  ///< "where its numbers are millimetres"
};

/// The likely unit of length of a scene that may not be in metres.
struct UnitGuess {
  std::string unit;  ///< "centimetres"; empty: only the size suggests that it is not metres
  std::string reason;
  std::optional<double> scale = {};       ///< to metres; none where no unit is likely
  std::vector<UnitRemedy> remedies = {};  ///< if `unit` is empty: scales for the case that metres are wrong
};

/// Returns the longest edge of a scene's bounds, m.
double longestEdge(const CompiledScene& scene);

/// Returns nullopt for a scene with the size of an object, a room, a building or the land around it. `bends`:
/// the scene has skins or morph targets, as figures do; these are smaller, so that a large size reveals the
/// unit. For other scenes the size alone does not: a landscape of a kilometre and a machine part of a metre
/// in millimetres have the same numbers.
std::optional<UnitGuess> guessUnit(const CompiledScene& scene, bool bends);

}  // namespace prelight
