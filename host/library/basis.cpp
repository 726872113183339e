#include "prelight/basis.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "base/parallel.h"
#include "basis/ch.h"
#include "basis/cube_map.h"
#include "basis/cube_overlap.h"
#include "basis/haar.h"
#include "basis/quadrature.h"
#include "basis/sh.h"
#include "prelight/error.h"

namespace prelight {

namespace {

constexpr int mostDegree = 1024;
constexpr std::size_t directionsPerRange = 1024;

template <typename T>
void requireWhole(const char* where, std::span<const T> values, std::size_t row) {
  if (values.empty() || values.size() % row != 0)
    throw UsageError(where, fmt::format("got {} values, expected a multiple of {}", values.size(), row));
  for (std::size_t i = 0; i < values.size(); ++i)
    if (!std::isfinite(values[i]))
      throw UsageError(where, fmt::format("value {} is {}, expected a finite number", i, values[i]));
}

std::size_t termsOf(int order, const char* where) {
  sh::checkOrder(order, where);
  return static_cast<std::size_t>(sh::coefficientCount(order));
}

/// Applies a map to each function of order^2 coefficients.
std::vector<double> mapFunctions(std::span<const double> functions, int order, const char* where,
                                 const std::function<void(std::span<const double>, std::span<double>)>& map) {
  const std::size_t terms = termsOf(order, where);
  requireWhole(where, functions, terms);
  std::vector<double> mapped(functions.size());
  for (std::size_t first = 0; first < functions.size(); first += terms)
    map(functions.subspan(first, terms), std::span(mapped).subspan(first, terms));
  return mapped;
}

std::vector<glm::dvec3> unitOf(std::span<const glm::dvec3> directions, const char* where) {
  std::vector<glm::dvec3> units(directions.size());
  for (std::size_t i = 0; i < directions.size(); ++i) {
    const double length = glm::length(directions[i]);
    if (!(length > 0.0) || !std::isfinite(length))
      throw UsageError(where, fmt::format("direction {} is ({}, {}, {}), expected finite numbers, not all 0",
                                          i, directions[i].x, directions[i].y, directions[i].z));
    units[i] = directions[i] / length;
  }
  return units;
}

/// Returns the number of texels of one map; `values` holds several, one after another.
std::size_t texelsOf(std::span<const float> values, int faceSize, const char* where) {
  checkCubeFaceSize(faceSize, where);
  requireWhole(where, values, cubeTexelCount(faceSize));
  return cubeTexelCount(faceSize);
}

}  // namespace

std::vector<double> basisValues(HarmonicBasis basis, std::span<const glm::dvec3> directions, int order) {
  const std::size_t terms = termsOf(order, "basisValues");
  const std::vector<glm::dvec3> units = unitOf(directions, "basisValues");
  std::vector<double> values(units.size() * terms);
  parallelRanges(units.size(), directionsPerRange, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const std::span<double> row = std::span(values).subspan(i * terms, terms);
      basis == HarmonicBasis::Sh ? sh::evaluate(units[i], order, row) : ch::evaluate(units[i], order, row);
    }
  });
  return values;
}

SphereRule sphereRule(int degree) {
  if (degree < 0 || degree > mostDegree)
    throw UsageError("sphereRule", fmt::format("got degree {}, expected 0 to {}", degree, mostDegree));
  SphereRule rule;
  for (const SphereSample& sample : sphereQuadrature(degree)) {
    rule.directions.push_back(sample.direction);
    rule.weights.push_back(sample.weight);
  }
  return rule;
}

std::vector<double> projectSky(const Environment& sky, int order) {
  return sh::projectEnvironment(sky, order);
}

std::vector<double> rotateHarmonics(HarmonicBasis basis, std::span<const double> coefficients, int order,
                                    const glm::dmat3& rotation) {
  const sh::ShRotation turn(order, rotation);
  if (basis == HarmonicBasis::Sh)
    return mapFunctions(coefficients, order, "rotateHarmonics",
                        [&](std::span<const double> in, std::span<double> out) { turn.apply(in, out); });
  const ch::Basis maps(order);
  return mapFunctions(coefficients, order, "rotateHarmonics",
                      [&](std::span<const double> in, std::span<double> out) { maps.rotate(turn, in, out); });
}

std::vector<double> chFromSh(std::span<const double> sh, int order) {
  const ch::Basis maps(order);
  return mapFunctions(sh, order, "chFromSh",
                      [&](std::span<const double> in, std::span<double> out) { maps.fromSh(in, out); });
}

std::vector<double> shFromCh(std::span<const double> ch, int order) {
  const ch::Basis maps(order);
  return mapFunctions(ch, order, "shFromCh",
                      [&](std::span<const double> in, std::span<double> out) { maps.toSh(in, out); });
}

std::vector<double> chMomentsFromSh(std::span<const double> sh, int order) {
  const ch::Basis maps(order);
  return mapFunctions(sh, order, "chMomentsFromSh", [&](std::span<const double> in, std::span<double> out) {
    maps.momentsFromSh(in, out);
  });
}

std::vector<glm::vec3> cubeOfSky(const Environment& sky, int faceSize) {
  return cubeFromEnvironment(sky, faceSize).radiance;
}

std::vector<glm::dvec3> cubeDirections(int faceSize) {
  checkCubeFaceSize(faceSize, "cubeDirections");
  std::vector<glm::dvec3> directions(cubeTexelCount(faceSize));
  for (std::uint32_t texel = 0; texel < directions.size(); ++texel)
    directions[texel] = cubeTexelDirection(texel, faceSize);
  return directions;
}

void haarForward(std::span<float> values, int faceSize) {
  const std::size_t texels = texelsOf(values, faceSize, "haarForward");
  for (std::size_t first = 0; first < values.size(); first += texels)
    haar::forward(values.subspan(first, texels), faceSize);
}

void haarInverse(std::span<float> values, int faceSize) {
  const std::size_t texels = texelsOf(values, faceSize, "haarInverse");
  for (std::size_t first = 0; first < values.size(); first += texels)
    haar::inverse(values.subspan(first, texels), faceSize);
}

std::vector<float> rotateCube(std::span<const float> texels, int faceSize, const glm::dmat3& rotation) {
  const std::size_t count = texelsOf(texels, faceSize, "rotateCube");
  (void)sh::ShRotation(1, rotation);  // checks that it is orthonormal
  const CubeResampling turn = rotateByArea(rotation, faceSize);
  std::vector<float> rotated(texels.size());
  for (std::size_t first = 0; first < texels.size(); first += count)
    for (std::size_t t = 0; t < count; ++t) {
      double sum = 0.0;
      for (std::uint32_t k = turn.offsets[t]; k < turn.offsets[t + 1]; ++k)
        sum += double(turn.weights[k]) * double(texels[first + turn.sources[k]]);
      rotated[first + t] = static_cast<float>(sum);
    }
  return rotated;
}

std::vector<std::uint32_t> haarKept(std::span<const float> coefficients, double relativeError) {
  if (!(relativeError >= 0.0 && relativeError <= 1.0))
    throw UsageError("haarKept", fmt::format("got an error of {}, expected 0 to 1", relativeError));
  requireWhole("haarKept", coefficients, std::max<std::size_t>(coefficients.size(), 1));
  return haar::keepError(coefficients, relativeError).indices;
}

}  // namespace prelight
