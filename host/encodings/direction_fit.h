#pragma once

#include <array>
#include <cmath>
#include <glm/glm.hpp>
#include <span>

#include "encodings/least_squares.h"

/// Fits of encodings that store one direction for all channels, and the colours of functions that depend on
/// it.
namespace prelight {

/// Returns the direction of the lamp that remains of the luminance when an even sky over the surface is
/// subtracted (docs/notes/lightmaps.md, "Normal maps"): a unit vector relative to the frame, or the surface's
/// normal if no lamp remains. `incident` is as in Encoding::encode.
glm::dvec3 dominantDirection(std::span<const float> incident, const glm::mat3& frame);

/// Returns the unit direction of three stored numbers, or `normal` if they are 0.
glm::vec3 storedDirection(std::span<const float> values, const glm::vec3& normal);

/// Stores a direction, given relative to the frame, in world space with the luminance of `colour` as its
/// length. When places are interpolated, those with the strongest directional light then count most.
void storeDirection(const glm::dvec3& direction, const glm::mat3& frame, const glm::dvec3& colour,
                    std::span<float> values);

/// Returns the weighted squared irradiance over the fit normals, summed over channels.
double squareOf(const FitIrradiance& irradiance);

template <std::size_t count>
struct DirectedFit {
  glm::dvec3 direction{0.0, 0.0, 1.0};  ///< relative to the frame
  FitColours<count> colours{};
  double error = 0.0;  ///< relativeError()
};

/// Relative increase of the diagonal that pulls colours towards 0 where other functions can replace them.
constexpr double directedRidge = 1e-6;

/// Returns the best colours for one direction. `functions(normal, direction)` returns the functions of a
/// normal, both relative to the frame. All colours but the first `free` are constrained to be >= 0.
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

/// Decrease of the error, relative to the squared light, that justifies turning a direction. Smaller gains
/// are below what the measured bands resolve.
constexpr double worthATurn = 3e-4;

/// Returns the best colours and direction near `start`, by descent on the error with decreasing steps.
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
