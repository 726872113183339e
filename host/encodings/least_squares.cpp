#include "encodings/least_squares.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
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

namespace {

/// A function whose component independent of earlier ones is below this share of its square counts as
/// dependent.
constexpr double smallestPivot = 1e-12;

/// The passive set: functions that may be other than 0, in order of entry.
struct Passive {
  std::array<std::size_t, mostFitFunctions> functions{};
  std::size_t count = 0;

  void add(std::size_t function) { functions[count++] = function; }

  void remove(std::size_t place) {
    std::copy(functions.begin() + place + 1, functions.begin() + count, functions.begin() + place);
    --count;
  }
};

/// Solves for the passive functions by Cholesky decomposition.
std::array<double, mostFitFunctions> solvePassive(std::span<const double> matrix,
                                                  std::span<const double> right, const Passive& passive) {
  const std::size_t n = right.size(), count = passive.count;
  std::array<double, mostFitFunctions * mostFitFunctions> lower;
  std::array<double, mostFitFunctions> x{};
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t row = passive.functions[i];
    double rest = right[row];
    for (std::size_t j = 0; j <= i; ++j) {
      double sum = matrix[row * n + passive.functions[j]];
      for (std::size_t k = 0; k < j; ++k) sum -= lower[i * count + k] * lower[j * count + k];
      const double pivot = lower[j * count + j];
      if (j < i) lower[i * count + j] = pivot > 0.0 ? sum / pivot : 0.0;
      if (j == i) lower[i * count + i] = sum > smallestPivot * matrix[row * n + row] ? std::sqrt(sum) : 0.0;
    }
    for (std::size_t k = 0; k < i; ++k) rest -= lower[i * count + k] * x[k];
    const double pivot = lower[i * count + i];
    x[i] = pivot > 0.0 ? rest / pivot : 0.0;
  }
  for (std::size_t i = count; i-- > 0;) {
    for (std::size_t k = i + 1; k < count; ++k) x[i] -= lower[k * count + i] * x[k];
    const double pivot = lower[i * count + i];
    x[i] = pivot > 0.0 ? x[i] / pivot : 0.0;
  }
  return x;
}

/// Returns the function at 0 whose growth reduces the error fastest, or n if none does.
std::size_t steepest(std::span<const double> matrix, std::span<const double> right, std::span<const double> x,
                     const Passive& passive) {
  const std::size_t n = right.size();
  std::size_t best = n;
  double most = 0.0;
  for (std::size_t i = 0; i < n; ++i) {
    const auto end = passive.functions.begin() + passive.count;
    if (std::find(passive.functions.begin(), end, i) != end) continue;
    double slope = right[i], size = std::abs(right[i]);
    for (std::size_t j = 0; j < n; ++j) {
      slope -= matrix[i * n + j] * x[j];
      size += std::abs(matrix[i * n + j] * x[j]);
    }
    if (slope <= 1e-10 * size || slope <= most) continue;
    most = slope;
    best = i;
  }
  return best;
}

/// Moves x towards the passive functions' solution until one of them reaches 0 and leaves the set. Returns
/// false if none does.
bool stepToBound(const std::array<double, mostFitFunctions>& solution, std::span<double> x, std::size_t free,
                 Passive& passive) {
  double step = 1.0;
  std::size_t first = passive.count;
  for (std::size_t i = free; i < passive.count; ++i) {
    if (solution[i] > 0.0) continue;
    const double before = x[passive.functions[i]];
    const double until = before > 0.0 ? before / (before - solution[i]) : 0.0;
    if (first < passive.count && until >= step) continue;
    step = until;
    first = i;
  }
  for (std::size_t i = 0; i < passive.count; ++i) {
    double& value = x[passive.functions[i]];
    value += step * (solution[i] - value);
  }
  if (first == passive.count) return false;
  x[passive.functions[first]] = 0.0;
  passive.remove(first);
  return true;
}

}  // namespace

void solveLeastSquares(std::span<const double> matrix, std::span<const double> right, std::span<double> x,
                       std::size_t free) {
  const std::size_t n = right.size();
  assert(n <= mostFitFunctions && matrix.size() == n * n && x.size() == n && free <= n);
  std::fill(x.begin(), x.end(), 0.0);
  Passive passive;
  while (passive.count < free) passive.add(passive.count);
  if (free > 0) stepToBound(solvePassive(matrix, right, passive), x, free, passive);
  for (std::size_t round = 0; round < 3 * n; ++round) {
    const std::size_t entering = steepest(matrix, right, x, passive);
    if (entering == n) return;
    passive.add(entering);
    while (stepToBound(solvePassive(matrix, right, passive), x, free, passive)) {
    }
  }
}

}  // namespace prelight
