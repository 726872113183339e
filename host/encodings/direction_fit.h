#pragma once

#include <array>
#include <cmath>
#include <glm/glm.hpp>
#include <span>

#include "encodings/least_squares.h"

/// Fits of encodings that store one direction for all channels, and colours of functions that depend on it.
namespace prelight {

/// Direction, relative to the frame, of the lamp that remains of the luminance when an even sky over the
/// surface is taken from it (docs/lightmaps.md, "Normal maps"): a unit vector; the surface's normal where
/// there is none. `incident` as in Encoding::encode.
glm::dvec3 dominantDirection(std::span<const float> incident, const glm::mat3& frame);

/// The direction that three stored numbers stand for: a unit vector, `normal` where they are 0.
glm::vec3 storedDirection(std::span<const float> values, const glm::vec3& normal);

/// Stores a direction relative to the frame in world space, as long as `colour` is bright: where places are
/// interpolated, those count most whose light has a direction.
void storeDirection(const glm::dvec3& direction, const glm::mat3& frame, const glm::dvec3& colour,
                    std::span<float> values);

/// The weighted square of irradiance over the fit normals, of all channels.
double squareOf(const FitIrradiance& irradiance);

template <std::size_t count>
struct DirectedFit {
  glm::dvec3 direction{0.0, 0.0, 1.0};  ///< relative to the frame
  FitColours<count> colours{};
  double error = 0.0;  ///< relativeError()
};

/// Share of a function's square that holds it at 0 where others can take its place.
constexpr double directedRidge = 1e-6;

/// Colours for one direction. `functions(normal, direction)` gives the functions of a normal, both relative
/// to the frame; all colours but the first `free` are 0 or above.
template <std::size_t count, typename Functions>
DirectedFit<count> fitColours(const FitIrradiance& wanted, const glm::dvec3& direction, Functions functions,
                              std::size_t free) {
  FitFunctions<count> values;
  for (std::size_t n = 0; n < fitNormalCount; ++n)
    values[n] = functions(fitNormals()[n].direction, direction);
  GramMatrix<count> gram = gramMatrix<count>(values);
  for (std::size_t i = free; i < count; ++i) gram[i * count + i] *= 1.0 + directedRidge;
  const FitColours<count> right = rightSide<count>(values, wanted);
  DirectedFit<count> fit{direction, solveColours<count>(gram, right, free), 0.0};
  fit.error = relativeError<count>(gram, right, fit.colours);
  return fit;
}

/// What a turn must lessen the error by, in shares of the light's square: of one direction the bands that
/// were measured tell no more.
constexpr double worthATurn = 3e-4;

/// The best colours and direction near `start`: goes the way on which the error falls, by ever smaller steps.
template <std::size_t count, typename Functions>
DirectedFit<count> fitDirection(const FitIrradiance& wanted, const glm::dvec3& start, Functions functions,
                                std::size_t free, double worth = worthATurn) {
  constexpr double firstStep = 0.3, lastStep = 0.015;  // radians
  constexpr int mostRounds = 20;
  const double squares = squareOf(wanted);
  DirectedFit<count> best = fitColours<count>(wanted, start, functions, free);
  double step = firstStep;
  for (int round = 0; round < mostRounds && step > lastStep; ++round) {
    const glm::dvec3 centre = best.direction;
    const glm::dvec3 helper = std::abs(centre.z) < 0.9 ? glm::dvec3(0, 0, 1) : glm::dvec3(1, 0, 0);
    const glm::dvec3 side = glm::normalize(glm::cross(helper, centre)), up = glm::cross(centre, side);
    bool better = false;
    for (const glm::dvec3& way : {side, -side, up, -up}) {
      const glm::dvec3 there = glm::normalize(centre + step * way);
      const DirectedFit<count> fit = fitColours<count>(wanted, there, functions, free);
      if (!(fit.error < best.error - worth * squares)) continue;
      best = fit;
      better = true;
    }
    if (!better) step *= 0.5;
  }
  return best;
}

}  // namespace prelight
