#include "scene/unit_guess.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace prelight {
namespace {

constexpr double largestFigure = 25.0, largestScene = 500.0, smallestScene = 0.003;  // m

/// Sizes that things and rooms have, m: a unit that brings a scene to one of them is likely.
constexpr double leastUsual = 0.03, mostUsual = 60.0;
/// What --scale takes.
constexpr double leastScale = 1e-9, mostScale = 1e9;
/// A figure is about as large as a person.
constexpr double mostFigure = 6.0;

struct LengthUnit {
  const char* name;
  double metres;
};

}  // namespace

double longestEdge(const CompiledScene& scene) {
  const glm::dvec3 size(scene.boundsMax - scene.boundsMin);
  return std::max({size.x, size.y, size.z});
}

std::optional<UnitGuess> guessUnit(const CompiledScene& scene, bool bends) {
  const double size = longestEdge(scene), largest = bends ? largestFigure : largestScene;
  if (!(size > 0.0) || (size >= smallestScene && size <= largest)) return std::nullopt;
  const auto guess = [&](const char* unit, const std::string& reason, double scale) {
    UnitGuess made{unit, reason};
    if (scale >= leastScale && scale <= mostScale && size * scale >= smallestScene && size * scale <= largest)
      made.scale = scale;
    return made;
  };
  if (size < smallestScene)
    return guess("metres, divided by 1000 once too often",
                 fmt::format("the scene is {:.3g} mm large", 1000.0 * size), 1000.0);
  const std::string reason =
      fmt::format("the scene{} is {:.4g} m large", bends ? " with a figure" : "", size);
  constexpr LengthUnit millimetres{"millimetres", 0.001}, centimetres{"centimetres", 0.01};
  // Files of figures are in centimetres more often, those of parts in millimetres.
  for (const LengthUnit& unit :
       bends ? std::array{centimetres, millimetres} : std::array{millimetres, centimetres})
    if (size * unit.metres >= leastUsual && size * unit.metres <= (bends ? mostFigure : mostUsual))
      return guess(unit.name, reason, unit.metres);
  return guess("units of its own", reason + ", beyond any usual unit",
               std::pow(10.0, -std::ceil(std::log10(size))));
}

}  // namespace prelight
