#include "fit/error_estimate.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/kept_work.h"
#include "base/parallel.h"
#include "fit/group_solver.h"

namespace prelight {

namespace {

/// [slot][group], deviations of AO; the sum of their squares is its variance.
using Deviations = std::vector<float>;

constexpr std::size_t slotGrain = 4096;

/// Returns the mean of each slot's value with its neighbours' values, because a variance from eight groups is
/// only good to a factor of 2.
std::vector<double> neighbourMean(const FitMesh& mesh, const std::vector<double>& values) {
  std::vector<double> means(values.size());
  parallelRanges(values.size(), slotGrain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      double sum = values[i];
      for (std::uint32_t e = mesh.rowStart[i]; e < mesh.rowStart[i + 1]; ++e) sum += values[mesh.columns[e]];
      means[i] = sum / static_cast<double>(1 + mesh.rowStart[i + 1] - mesh.rowStart[i]);
    }
  });
  return means;
}

/// Subtracts the mean over groups from every slot's values and scales them.
Deviations centred(std::vector<float> values, double factor) {
  parallelRanges(values.size() / errorGroups, slotGrain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t first = begin * errorGroups; first < end * errorGroups; first += errorGroups) {
      double mean = 0.0;
      for (std::size_t g = 0; g < errorGroups; ++g) mean += values[first + g] / double(errorGroups);
      for (std::size_t g = 0; g < errorGroups; ++g)
        values[first + g] = static_cast<float>(factor * (values[first + g] - mean));
    }
  });
  return values;
}

/// Changes of the fit due to groups, as a lower and an upper bound.
struct Bracket {
  Deviations low, high;
};

template <std::size_t W>
void copyGroups(const std::vector<float>& part, std::uint32_t firstGroup, Deviations& all) {
  for (std::size_t i = 0; i < part.size(); i += W)
    std::copy_n(&part[i], W, &all[i / W * errorGroups + firstGroup]);
}

template <std::size_t W>
Bracket movedBy(const FitMesh& mesh, const AoFit& all, const SampleRecords& records, int steps,
                const Progress& progress) {
  const std::size_t size = std::size_t{mesh.slotCount()} * errorGroups;
  Bracket bracket{Deviations(size), Deviations(size)};
  std::uint32_t first = 0;
  WorkPart part(progress, "error", [&](auto& state) {
    state.value(first);
    state.sameSize(bracket.low);
    state.sameSize(bracket.high);
    state.require(first <= errorGroups && first % W == 0);
  });
  for (; first < errorGroups; first += W, part.advance()) {
    const GroupSolver<W> solver(mesh, all, records, first, progress);
    std::vector<float> scores = solver.scores(), low = solver.solve(scores);
    copyGroups<W>(low, first, bracket.low);  // writes the same again where an interrupted step is repeated
    copyGroups<W>(solver.withoutGroups(std::move(scores), std::move(low), steps), first, bracket.high);
  }
  part.finish();
  return bracket;
}

Bracket bracketOf(const FitMesh& mesh, const AoFit& all, const SampleRecords& records,
                  const ErrorEffort& effort) {
  constexpr double groups = errorGroups;
  const Progress nobody;
  const Progress& progress = effort.progress != nullptr ? *effort.progress : nobody;
  Bracket bracket = effort.halfOfTheGroups
                        ? movedBy<errorGroups / 2>(mesh, all, records, effort.stepsWithoutGroups, progress)
                        : movedBy<errorGroups>(mesh, all, records, effort.stepsWithoutGroups, progress);
  bracket.high = centred(std::move(bracket.high), std::sqrt((groups - 1.0) / groups));
  bracket.low = centred(std::move(bracket.low), std::sqrt(groups / (groups - 1.0)));
  return bracket;
}

/// Returns the mean square of the interpolated deviations over the surface. The mean of a linear function's
/// square over a triangle is (a^2 + b^2 + c^2 + ab + bc + ca) / 6.
double surfaceMeanSquare(const FitMesh& mesh, const std::vector<double>& areas,
                         const Deviations& deviations) {
  struct Part {
    double sum = 0.0, area = 0.0;
  };
  std::vector<Part> parts((areas.size() + slotGrain - 1) / slotGrain);
  parallelRanges(areas.size(), slotGrain, [&](std::size_t begin, std::size_t end) {
    Part& part = parts[begin / slotGrain];
    for (std::size_t t = begin; t < end; ++t) {
      const auto& slots = mesh.triangles[t];
      double squares = 0.0;
      for (std::size_t g = 0; g < errorGroups; ++g) {
        const double a = deviations[slots[0] * errorGroups + g], b = deviations[slots[1] * errorGroups + g],
                     c = deviations[slots[2] * errorGroups + g];
        squares += (a * a + b * b + c * c + a * b + b * c + c * a) / 6.0;
      }
      part.sum += areas[t] * squares;
      part.area += areas[t];
    }
  });
  Part total;
  for (const Part& part : parts) total = {total.sum + part.sum, total.area + part.area};
  return total.area > 0.0 ? total.sum / total.area : 0.0;
}

/// Returns the ratio of the variance of all groups together to the variance that their scatter suggests,
/// which is smaller for stratified samples. If the variance falls like n^-(1 + b), the scatter of m groups
/// with 1/m of the receivers each exceeds it by the factor (m^(1 + b) - 1) / (m - 1). Comparing eight groups
/// with two halves made of consecutive groups gives b.
double complementFactor(const FitMesh& mesh, const std::vector<double>& areas, const Deviations& groups) {
  Deviations halves(groups.size(), 0.0f);
  parallelRanges(groups.size() / errorGroups, slotGrain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin * errorGroups; i < end * errorGroups; ++i)
      halves[i - i % errorGroups] += i % errorGroups < errorGroups / 2 ? groups[i] : -groups[i];
  });
  const double unscale = (errorGroups - 1.0) / errorGroups;  // deviations carry the root of the inverse
  const double ofGroups = surfaceMeanSquare(mesh, areas, groups);
  const double ofHalves = unscale * surfaceMeanSquare(mesh, areas, halves);
  const auto excess = [](double m, double b) { return (std::pow(m, 1.0 + b) - 1.0) / (m - 1.0); };
  double low = 0.0, high = 1.0;  // b ranges from independent samples to the best of (0,2)-sequences at edges
  for (int i = 0; i < 30; ++i) {
    const double b = 0.5 * (low + high);
    (ofGroups * excess(2.0, b) > ofHalves * excess(errorGroups, b) ? low : high) = b;
  }
  return 1.0 / excess(errorGroups, low);
}

/// Returns the sums of squares, [slot].
std::vector<double> variances(const Deviations& deviations) {
  std::vector<double> sums(deviations.size() / errorGroups, 0.0);
  parallelRanges(sums.size(), slotGrain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin * errorGroups; i < end * errorGroups; ++i)
      sums[i / errorGroups] += double(deviations[i]) * deviations[i];
  });
  return sums;
}

}  // namespace

ErrorEstimate estimateAoError(const FitMesh& mesh, const AoFit& all, const std::vector<double>& areas,
                              const SampleRecords& records, std::uint64_t receivers, bool independent,
                              const ErrorEffort& effort) {
  const auto [low, high] = bracketOf(mesh, all, records, effort);
  // Receivers without a record reduce the variance in proportion.
  double share = receivers > 0 ? static_cast<double>(records.size()) / static_cast<double>(receivers) : 1.0;
  if (!independent) share *= complementFactor(mesh, areas, low);
  ErrorEstimate estimate;
  estimate.rms = std::sqrt(
      share * std::sqrt(surfaceMeanSquare(mesh, areas, low) * surfaceMeanSquare(mesh, areas, high)));
  const std::vector<double> lowSlots = neighbourMean(mesh, variances(low)),
                            highSlots = neighbourMean(mesh, variances(high));
  for (std::size_t s = 0; s < lowSlots.size(); ++s) {
    estimate.slots.push_back(std::sqrt(share * std::sqrt(lowSlots[s] * highSlots[s])));
    estimate.max = std::max(estimate.max, estimate.slots.back());
  }
  return estimate;
}

}  // namespace prelight
