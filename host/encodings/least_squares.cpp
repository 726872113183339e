#include "encodings/least_squares.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

namespace prelight {
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
