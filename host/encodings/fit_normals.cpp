#include "encodings/fit_normals.h"

#include <cassert>
#include <cmath>
#include <numbers>

#include "basis/quadrature.h"
#include "basis/sh_evaluate.h"
#include "basis/sh_zonal.h"
#include "encodings/encoding.h"

namespace prelight {
namespace {

constexpr std::size_t fitRows = 6;
constexpr std::size_t fitColumns = fitNormalCount / fitRows;

std::array<FitNormal, fitNormalCount> makeFitNormals() {
  std::array<FitNormal, fitNormalCount> normals;
  std::size_t i = 0;
  for (const LineSample& row : gaussLegendre(fitRows)) {
    const double z = 0.5 * (row.position + 1.0);
    const double radius = std::sqrt(1.0 - z * z);
    for (std::size_t column = 0; column < fitColumns; ++column) {
      const double phi = 2.0 * std::numbers::pi * (static_cast<double>(column) + 0.5) / fitColumns;
      normals[i++] = {{radius * std::cos(phi), radius * std::sin(phi), z}, row.weight * z / fitColumns};
    }
  }
  return normals;
}

/// Returns the factor of each SH coefficient from radiance to irradiance.
std::array<double, incidentTerms> cosineFactors() {
  std::array<double, incidentTerms> factors{};
  for (int l = 0; l < incidentOrder; ++l)
    for (int i = l * l; i < (l + 1) * (l + 1); ++i)
      factors[static_cast<std::size_t>(i)] = std::numbers::pi * sh::clampedCosine(l);
  return factors;
}

}  // namespace

const std::array<FitNormal, fitNormalCount>& fitNormals() {
  static const std::array<FitNormal, fitNormalCount> normals = makeFitNormals();
  return normals;
}

FitIrradiance fitIrradiance(std::span<const float> incident, const glm::mat3& frame) {
  static const std::array<double, incidentTerms> factors = cosineFactors();
  assert(incident.size() == 3 * incidentTerms);
  const glm::dmat3 toWorld(frame);
  FitIrradiance irradiance;
  std::array<double, incidentTerms> harmonics;
  for (std::size_t n = 0; n < fitNormalCount; ++n) {
    sh::evaluate(toWorld * fitNormals()[n].direction, incidentOrder, harmonics);
    glm::dvec3 sum(0.0);
    for (std::size_t i = 0; i < incidentTerms; ++i) {
      const double value = factors[i] * harmonics[i];
      sum += value * glm::dvec3(incident[i], incident[incidentTerms + i], incident[2 * incidentTerms + i]);
    }
    irradiance[n] = sum;
  }
  return irradiance;
}

}  // namespace prelight
