#include "encodings/encodings.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>
#include <vector>

#include "base/directions.h"
#include "encodings/direction_fit.h"
#include "encodings/encoding.h"

namespace prelight {
namespace {

// Lamps can take over light from one another, so that even small gains count.
constexpr double worthATurnAmongOthers = 2e-5;
// Relative gain of the squared error that justifies a lamp. 1.8 % of a lamp's light lie beyond the measured
// bands; the bound is several times the square of that, so that no lamp serves only to fit the truncation.
constexpr double worthALamp = 1e-3;
constexpr std::size_t residual = 2;  ///< number of colours that may be negative, as lamps compensate for them

template <std::size_t lamps>
struct LampFit {
  std::array<glm::dvec3, lamps> directions{};  ///< relative to the frame
  FitColours<residual + lamps> colours{};
  double error = std::numeric_limits<double>::infinity();  ///< relativeError()
};

template <std::size_t lamps>
std::array<double, residual + lamps> functionsOf(const glm::dvec3& normal,
                                                 const std::array<glm::dvec3, lamps>& directions) {
  std::array<double, residual + lamps> values{0.5 + 0.5 * normal.z, 0.5 - 0.5 * normal.z};
  for (std::size_t i = 0; i < lamps; ++i)
    values[residual + i] = std::max(glm::dot(normal, directions[i]), 0.0);
  return values;
}

/// Returns the functions with lamp `turned` in a variable direction and the other lamps fixed.
template <std::size_t lamps>
auto functionsTurning(const std::array<glm::dvec3, lamps>& directions, std::size_t turned) {
  return [directions, turned](const glm::dvec3& normal, const glm::dvec3& direction) {
    auto moved = directions;
    moved[turned] = direction;
    return functionsOf<lamps>(normal, moved);
  };
}

/// Turns each lamp in turn to the direction of least error while the others stay; all colours are fitted
/// anew.
template <std::size_t lamps>
void turnLamps(const FitIrradiance& wanted, LampFit<lamps>& fit) {
  constexpr int rounds = lamps == 1 ? 1 : 5;
  for (int round = 0; round < rounds; ++round)
    for (std::size_t i = 0; i < lamps; ++i) {
      const DirectedFit<residual + lamps> found = fitDirection<residual + lamps>(
          wanted, fit.directions[i], functionsTurning<lamps>(fit.directions, i), residual,
          lamps == 1 ? worthATurn : worthATurnAmongOthers);
      fit.directions[i] = found.direction;
      fit.colours = found.colours;
      fit.error = found.error;
    }
}

/// Returns directions above the surface, relative to the frame, evenly distributed in world space.
std::vector<glm::dvec3> directionsAbove(const glm::mat3& frame) {
  constexpr int count = 48;
  std::vector<glm::dvec3> above;
  for (const glm::dvec3& world : spiralDirections(count)) {
    const glm::dvec3 direction = glm::transpose(glm::dmat3(frame)) * world;
    if (direction.z > 0.0) above.push_back(direction);
  }
  return above;
}

/// Adds a dark lamp along the normal.
template <std::size_t lamps>
LampFit<lamps> withADarkLamp(const LampFit<lamps - 1>& fewer) {
  LampFit<lamps> fit;
  std::copy(fewer.directions.begin(), fewer.directions.end(), fit.directions.begin());
  std::copy(fewer.colours.begin(), fewer.colours.end(), fit.colours.begin());
  fit.directions.back() = {0.0, 0.0, 1.0};
  fit.error = fewer.error;
  return fit;
}

/// Adds to a fit of fewer lamps the lamp that reduces the error most, and turns all of them. If that gains
/// too little, the added lamp is dark.
template <std::size_t lamps>
LampFit<lamps> fitLamps(const FitIrradiance& wanted, const glm::dvec3& first,
                        const std::vector<glm::dvec3>& candidates) {
  LampFit<lamps> best;
  if constexpr (lamps == 1) {
    best.directions = {first};
    turnLamps<lamps>(wanted, best);
    return best;
  } else {
    const LampFit<lamps> fewer = withADarkLamp<lamps>(fitLamps<lamps - 1>(wanted, first, candidates));
    LampFit<lamps> tried = fewer;
    for (const glm::dvec3& candidate : candidates) {
      tried.directions.back() = candidate;
      tried.error = fitColours<residual + lamps>(
                        wanted, candidate, functionsTurning<lamps>(tried.directions, lamps - 1), residual)
                        .error;
      if (tried.error < best.error) best = tried;
    }
    turnLamps<lamps>(wanted, best);
    return best.error < fewer.error - worthALamp * squareOf(wanted) ? best : fewer;
  }
}

/// Returns the order of lamps along a fixed line, so that neighbouring places, between which they are
/// interpolated, agree on it. The line is not a coordinate axis, along which rooms and lamps are often
/// symmetric.
template <std::size_t lamps>
std::array<std::size_t, lamps> lampOrder(const LampFit<lamps>& fit, const glm::mat3& frame) {
  const glm::dvec3 line = glm::transpose(glm::dmat3(frame)) * glm::dvec3(0.78, 0.12, 0.61);
  std::array<std::size_t, lamps> order;
  for (std::size_t i = 0; i < lamps; ++i) order[i] = i;
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return glm::dot(fit.directions[a], line) < glm::dot(fit.directions[b], line);
  });
  return order;
}

/// Returns a frame of the normal that does not depend on the surface's tangents: the stored values are
/// independent of them, while fits of several lamps, which may have several optima, should be so too.
glm::mat3 frameOf(const glm::vec3& normal) {
  const glm::vec3 helper = std::abs(normal.z) < 0.9f ? glm::vec3(0, 0, 1) : glm::vec3(1, 0, 0);
  const glm::vec3 tangent = glm::normalize(glm::cross(helper, normal));
  return {tangent, glm::cross(normal, tangent), normal};
}

template <std::size_t lamps>
void encodeDominantDirections(std::span<const float> incident, const glm::mat3& tangents,
                              std::span<float> values) {
  assert(values.size() == 6 * lamps + 6);
  const glm::mat3 frame = frameOf(tangents[2]);
  const LampFit<lamps> fit =
      fitLamps<lamps>(fitIrradiance(incident, frame), dominantDirection(incident, frame),
                      lamps == 1 ? std::vector<glm::dvec3>() : directionsAbove(frame));
  FitColours<residual + lamps> colours = fit.colours;
  const std::array<std::size_t, lamps> order = lampOrder<lamps>(fit, frame);
  for (std::size_t i = 0; i < lamps; ++i) {
    colours[residual + i] = fit.colours[residual + order[i]];
    storeDirection(fit.directions[order[i]], frame, colours[residual + i], values.subspan(3 * i));
  }
  storeColours<residual + lamps>(colours, values.subspan(3 * lamps));
}

template <std::size_t lamps>
glm::vec3 dominantDirectionsIrradiance(std::span<const float> values, const glm::mat3& frame,
                                       const glm::vec3& normal) {
  assert(values.size() == 6 * lamps + 6);
  const float up = glm::dot(normal, frame[2]);
  constexpr std::size_t first = 3 * lamps;
  glm::vec3 sum =
      (0.5f + 0.5f * up) * storedColour(values, first) + (0.5f - 0.5f * up) * storedColour(values, first + 3);
  for (std::size_t i = 0; i < lamps; ++i)
    sum += std::max(glm::dot(normal, storedDirection(values.subspan(3 * i), frame[2])), 0.0f) *
           storedColour(values, first + 6 + 3 * i);
  return glm::max(sum, glm::vec3(0.0f));
}

template <std::size_t lamps>
Encoding lampEncoding(const char* name, const char* summary) {
  static const std::string shader = "const int encodedLamps = " + std::to_string(lamps) + ";\n" +
                                    std::string(encodingShader("dominant_direction"));
  return {name,
          summary,
          6 * lamps + 6,
          false,
          encodeDominantDirections<lamps>,
          dominantDirectionsIrradiance<lamps>,
          shader};
}

}  // namespace

Encoding dominantDirectionEncoding(std::size_t lamps) {
  assert(lamps >= 1 && lamps <= 3);
  if (lamps == 1)
    return lampEncoding<1>("dominant-direction",
                           "a lamp in the dominant direction, and a hemisphere of what remains");
  if (lamps == 2)
    return lampEncoding<2>("dominant-directions-2", "two dominant lamps, and a hemisphere of what remains");
  return lampEncoding<3>("dominant-directions-3", "three dominant lamps, and a hemisphere of what remains");
}

}  // namespace prelight
