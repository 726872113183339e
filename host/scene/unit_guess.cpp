#include "scene/unit_guess.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace prelight {
namespace {

constexpr double largestFigure = 25.0, largestScene = 500.0, smallestScene = 0.003;  // m

/// Range of plausible sizes of figures, around that of a person, m.
constexpr double leastFigure = 0.03, mostFigure = 6.0;

struct LengthUnit {
  const char* name;
  double metres;
};
constexpr LengthUnit millimetres{"millimetres", 0.001}, centimetres{"centimetres", 0.01};

std::string sizeText(double size) {
  return size < smallestScene ? fmt::format("{:.3g} mm", 1000.0 * size) : fmt::format("{:.4g} m", size);
}

/// Returns a guess of the unit for a scene with a figure. Centimetres are tried first, because they are more
/// common than millimetres.
std::optional<UnitGuess> guessOfFigure(double size) {
  for (const LengthUnit& unit : {centimetres, millimetres})
    if (size * unit.metres >= leastFigure && size * unit.metres <= mostFigure)
      return UnitGuess{unit.name, fmt::format("the scene with a figure is {} large", sizeText(size)),
                       unit.metres};
  return std::nullopt;
}

std::vector<UnitRemedy> remediesOf(double size) {
  if (size < smallestScene) return {{1000.0, "if its metres were divided by 1000 once too often"}};
  return {{millimetres.metres, fmt::format("if its numbers are {}", millimetres.name)},
          {centimetres.metres, fmt::format("if they are {}", centimetres.name)}};
}

}  // namespace

double longestEdge(const CompiledScene& scene) {
  const glm::dvec3 size(scene.boundsMax - scene.boundsMin);
  return std::max({size.x, size.y, size.z});
}

std::optional<UnitGuess> guessUnit(const CompiledScene& scene, bool bends) {
  const double size = longestEdge(scene), largest = bends ? largestFigure : largestScene;
  if (!(size > 0.0) || (size >= smallestScene && size <= largest)) return std::nullopt;
  if (bends)
    if (const std::optional<UnitGuess> figure = guessOfFigure(size)) return figure;
  return UnitGuess{"", fmt::format("the scene is {} large", sizeText(size)), std::nullopt, remediesOf(size)};
}

}  // namespace prelight
