#include "fit/error_estimate.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <utility>

#include "base/parallel.h"

namespace prelight {

namespace {

/// Mean of each slot's value and its neighbours': eight groups alone make a variance that is good to a factor
/// of 2.
std::vector<double> neighbourMean(const FitMesh& mesh, const std::vector<double>& values) {
  std::vector<double> means(values.size());
  for (std::size_t i = 0; i < values.size(); ++i) {
    double sum = values[i];
    for (std::uint32_t e = mesh.rowStart[i]; e < mesh.rowStart[i + 1]; ++e) sum += values[mesh.columns[e]];
    means[i] = sum / static_cast<double>(1 + mesh.rowStart[i + 1] - mesh.rowStart[i]);
  }
  return means;
}

/// [slot][group], deviations of AO whose squares sum to its variance.
using Deviations = std::vector<float>;

/// Groups are solved for so many at a time, in half the memory.
constexpr std::uint32_t groupsAtOnce = 4;

/// [slot][groupsAtOnce], of groups from the one at hand on.
using Part = std::vector<float>;

constexpr std::size_t slotGrain = 4096;

/// Deviations are wanted to a percent; the noise that they are made of is not known as well.
SolveLimits roughly() { return {.tolerance = 1e-2, .iterations = 32, .verified = false}; }

/// Takes the groups' mean off every slot's values, and scales them.
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

/// What is fitted: AO relative to an open receiver's.
double valueOf(const SampleRecord& record) { return double(record.open) - 1.0; }

using GroupSums = std::array<double, groupsAtOnce>;

/// Sums over the slots of a b, a group.
GroupSums dots(const Part& a, const Part& b) {
  std::vector<GroupSums> parts((a.size() / groupsAtOnce + slotGrain - 1) / slotGrain, GroupSums{});
  parallelRanges(a.size() / groupsAtOnce, slotGrain, [&](std::size_t begin, std::size_t end) {
    GroupSums& part = parts[begin / slotGrain];
    for (std::size_t i = begin * groupsAtOnce; i < end * groupsAtOnce; ++i)
      part[i % groupsAtOnce] += double(a[i]) * b[i];
  });
  GroupSums sums{};
  for (const GroupSums& part : parts)
    for (std::size_t g = 0; g < groupsAtOnce; ++g) sums[g] += part[g];
  return sums;
}

/// a = factor[group] a + more[group] b
void combine(Part& a, const GroupSums& factor, const GroupSums& more, const Part& b) {
  parallelRanges(a.size() / groupsAtOnce, slotGrain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin * groupsAtOnce; i < end * groupsAtOnce; ++i)
      a[i] = static_cast<float>(factor[i % groupsAtOnce] * a[i] + more[i % groupsAtOnce] * b[i]);
  });
}

GroupSums ratios(const GroupSums& a, const GroupSums& b) {
  GroupSums quotients{};
  for (std::size_t g = 0; g < groupsAtOnce; ++g) quotients[g] = b[g] > 0.0 ? a[g] / b[g] : 0.0;
  return quotients;
}

GroupSums filled(double value) {
  GroupSums sums;
  sums.fill(value);
  return sums;
}

double total(const GroupSums& sums) { return std::accumulate(sums.begin(), sums.end(), 0.0); }

GroupSums negative(GroupSums sums) {
  for (double& sum : sums) sum = -sum;
  return sums;
}

/// The fit's equations A, solved for the right sides of groupsAtOnce groups.
class GroupSolver {
 public:
  GroupSolver(const FitMesh& mesh, const AoFit& all, const SampleRecords& records, std::uint32_t firstGroup)
      : mesh_(mesh), all_(all), records_(records), firstGroup_(firstGroup) {}

  /// The residuals' part of the normal equations: what a group alone adds to the right side beyond what the
  /// fit to all records explains.
  Part scores() const {
    Part scores(std::size_t{mesh_.slotCount()} * groupsAtOnce, 0.0f);
    const auto fitted = [&](std::uint32_t slot) { return double(all_.values[slot * all_.columns]); };
    addRecords(
        [&](const SampleRecord& record, const auto& slots, const auto& b) {
          return valueOf(record) -
                 (b[0] * fitted(slots[0]) + b[1] * fitted(slots[1]) + b[2] * fitted(slots[2]));
        },
        scores);
    return scores;
  }

  Part solve(Part right) const {
    return all_.fit.solve(all_.equations, std::move(right), groupsAtOnce, roughly());
  }

  /// How far leaving each group out moves the fit: (A - M) x = score, with M what the group's records have in
  /// A. Solved by conjugate gradients with A as the preconditioner, since M is about an eighth of it; A times
  /// a direction follows from how the direction is made. `first` is solve(scores).
  Part withoutGroups(Part scores, Part first) const {
    constexpr int mostSteps = 5;
    constexpr double enough = 2e-3;  // of the energy is left, as expected from what the step before has left
    GroupSums energy = dots(scores, first);
    Part moved(scores.size(), 0.0f), direction = std::move(first), ofAll = scores;
    const double start = total(energy);
    bool last = false;
    for (int step = 1;; ++step) {
      {
        const Part image = imageOf(direction, ofAll);
        const GroupSums length = ratios(energy, dots(direction, image));
        combine(moved, filled(1.0), length, direction);
        combine(scores, filled(1.0), negative(length), image);
      }
      if (last || step == mostSteps) return moved;
      const Part rest = solve(scores);
      const GroupSums left = dots(scores, rest), turn = ratios(left, energy);
      combine(direction, turn, filled(1.0), rest);
      combine(ofAll, turn, filled(1.0), scores);
      last = total(left) * total(left) <= enough * start * total(energy);
      energy = left;
    }
  }

 private:
  /// Adds what each record weighs times its value to its three slots, in its group's column. Groups are dealt
  /// to threads.
  template <typename Value>
  void addRecords(const Value& value, Part& sums) const {
    parallelRanges(groupsAtOnce, groupsAtOnce / 2, [&](std::size_t begin, std::size_t end) {
      const auto groupAt = [&](std::size_t place) { return firstGroup_ + static_cast<std::uint32_t>(place); };
      records_.forGroups(groupAt(begin), groupAt(end), [&](const SampleRecord& record) {
        const auto& slots = mesh_.triangles[record.sample.triangle];
        const auto b = cornerWeights(record.sample);
        const double weighted = all_.fit.weightOf(record.sample) * value(record, slots, b);
        for (std::size_t k = 0; k < 3; ++k)
          sums[placeOf(slots[k], record)] += static_cast<float>(b[k] * weighted);
      });
    });
  }

  std::size_t placeOf(std::uint32_t slot, const SampleRecord& record) const {
    return std::size_t{slot} * groupsAtOnce + record.group - firstGroup_;
  }

  /// (A - M) of, given A of.
  Part imageOf(const Part& of, Part ofAll) const {
    addRecords(
        [&](const SampleRecord& record, const auto& slots, const auto& b) {
          const auto at = [&](std::size_t k) { return of[placeOf(slots[k], record)]; };
          return -(b[0] * at(0) + b[1] * at(1) + b[2] * at(2));
        },
        ofAll);
    return ofAll;
  }

  const FitMesh& mesh_;
  const AoFit& all_;
  const SampleRecords& records_;
  std::uint32_t firstGroup_;
};

/// What groups move the fit by, from below and from above.
struct Bracket {
  Deviations low, high;
};

void copyGroups(const Part& part, std::uint32_t firstGroup, Deviations& all) {
  for (std::size_t i = 0; i < part.size(); ++i)
    all[i / groupsAtOnce * errorGroups + firstGroup + i % groupsAtOnce] = part[i];
}

Bracket bracketOf(const FitMesh& mesh, const AoFit& all, const SampleRecords& records) {
  constexpr double groups = errorGroups;
  const std::size_t size = std::size_t{mesh.slotCount()} * errorGroups;
  Bracket bracket{Deviations(size), Deviations(size)};
  for (std::uint32_t first = 0; first < errorGroups; first += groupsAtOnce) {
    const GroupSolver solver(mesh, all, records, first);
    Part scores = solver.scores(), low = solver.solve(scores);
    copyGroups(low, first, bracket.low);
    copyGroups(solver.withoutGroups(std::move(scores), std::move(low)), first, bracket.high);
  }
  bracket.high = centred(std::move(bracket.high), std::sqrt((groups - 1.0) / groups));
  bracket.low = centred(std::move(bracket.low), std::sqrt(groups / (groups - 1.0)));
  return bracket;
}

/// Mean square over the surface of the interpolated deviations. The mean of a linear function's square over a
/// triangle is (a^2 + b^2 + c^2 + ab + bc + ca) / 6.
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

/// How much smaller the variance of all groups together is than their scatter says. The scatter of m groups,
/// each with an m-th of the receivers, exceeds the variance (m^(1 + b) - 1) / (m - 1) times when that falls
/// like n^-(1 + b); consecutive groups make up the halves.
double complementFactor(const FitMesh& mesh, const std::vector<double>& areas, const Deviations& groups) {
  Deviations halves(groups.size(), 0.0f);
  for (std::size_t i = 0; i < groups.size(); ++i)
    halves[i - i % errorGroups] += i % errorGroups < errorGroups / 2 ? groups[i] : -groups[i];
  const double unscale = (errorGroups - 1.0) / errorGroups;  // deviations carry the root of its inverse
  const double ofGroups = surfaceMeanSquare(mesh, areas, groups);
  const double ofHalves = unscale * surfaceMeanSquare(mesh, areas, halves);
  const auto excess = [](double m, double b) { return (std::pow(m, 1.0 + b) - 1.0) / (m - 1.0); };
  double low = 0.0, high = 1.0;  // from independent samples to the best that (0,2)-sequences do for edges
  for (int i = 0; i < 30; ++i) {
    const double b = 0.5 * (low + high);
    (ofGroups * excess(2.0, b) > ofHalves * excess(errorGroups, b) ? low : high) = b;
  }
  return 1.0 / excess(errorGroups, low);
}

/// [slot], sums of squares.
std::vector<double> variances(const Deviations& deviations) {
  std::vector<double> sums(deviations.size() / errorGroups, 0.0);
  for (std::size_t i = 0; i < deviations.size(); ++i)
    sums[i / errorGroups] += double(deviations[i]) * deviations[i];
  return sums;
}

}  // namespace

ErrorEstimate estimateAoError(const FitMesh& mesh, const AoFit& all, const std::vector<double>& areas,
                              const SampleRecords& records, std::uint64_t receivers, bool independent) {
  const auto [low, high] = bracketOf(mesh, all, records);
  // The receivers without a record make the variance smaller in proportion.
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
