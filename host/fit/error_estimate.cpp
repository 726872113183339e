#include "fit/error_estimate.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <utility>

#include "base/parallel.h"
#include "base/prefetch.h"

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

constexpr std::size_t slotGrain = 4096;

/// Deviations are wanted to a percent; the noise that they are made of is not known as well.
SolveLimits roughly() { return {1e-2, 32, hardwareThreads()}; }

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

/// Adds what each record weighs times its value to its three slots, in its group's column. Groups are dealt
/// to threads.
template <typename Value>
void addRecords(const FitMesh& mesh, const VertexFit& fit, const std::vector<SampleRecord>& records,
                const Value& value, Deviations& sums) {
  constexpr std::size_t trianglesAhead = 16, slotsAhead = 8;
  const auto ask = [&](std::size_t i) {
    if (i + trianglesAhead < records.size())
      prefetch(&mesh.triangles[records[i + trianglesAhead].sample.triangle]);
    if (i + slotsAhead >= records.size()) return;
    for (const std::uint32_t slot : mesh.triangles[records[i + slotsAhead].sample.triangle])
      prefetch(&sums[slot * errorGroups], errorGroups);
  };
  parallelRanges(errorGroups, errorGroups / 2, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = 0; i < records.size(); ++i) {
      const SampleRecord& record = records[i];
      if (record.group < begin || record.group >= end) continue;
      ask(i);
      const auto& slots = mesh.triangles[record.sample.triangle];
      const auto b = cornerWeights(record.sample);
      const double weighted = fit.weightOf(record.sample) * value(record, slots, b);
      for (std::size_t k = 0; k < 3; ++k)
        sums[slots[k] * errorGroups + record.group] += static_cast<float>(b[k] * weighted);
    }
  });
}

/// [slot][group], the residuals' part of the normal equations: what a group alone adds to the right side
/// beyond what the fit to all records explains.
Deviations scoresOf(const FitMesh& mesh, const VertexFit& fit, const std::vector<SampleRecord>& records,
                    std::span<const float> values, std::size_t columns) {
  Deviations scores(std::size_t{mesh.slotCount()} * errorGroups, 0.0f);
  addRecords(
      mesh, fit, records,
      [&](const SampleRecord& record, const auto& slots, const auto& b) {
        return valueOf(record) - (b[0] * values[slots[0] * columns] + b[1] * values[slots[1] * columns] +
                                  b[2] * values[slots[2] * columns]);
      },
      scores);
  return scores;
}

using GroupSums = std::array<double, errorGroups>;

/// Sums over the slots of a b, a group.
GroupSums dots(const Deviations& a, const Deviations& b) {
  std::vector<GroupSums> parts((a.size() / errorGroups + slotGrain - 1) / slotGrain, GroupSums{});
  parallelRanges(a.size() / errorGroups, slotGrain, [&](std::size_t begin, std::size_t end) {
    GroupSums& part = parts[begin / slotGrain];
    for (std::size_t i = begin * errorGroups; i < end * errorGroups; ++i)
      part[i % errorGroups] += double(a[i]) * b[i];
  });
  GroupSums sums{};
  for (const GroupSums& part : parts)
    for (std::size_t g = 0; g < errorGroups; ++g) sums[g] += part[g];
  return sums;
}

/// a = factor[group] a + more[group] b
void combine(Deviations& a, const GroupSums& factor, const GroupSums& more, const Deviations& b) {
  parallelRanges(a.size() / errorGroups, slotGrain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin * errorGroups; i < end * errorGroups; ++i)
      a[i] = static_cast<float>(factor[i % errorGroups] * a[i] + more[i % errorGroups] * b[i]);
  });
}

GroupSums ratios(const GroupSums& a, const GroupSums& b) {
  GroupSums quotients{};
  for (std::size_t g = 0; g < errorGroups; ++g) quotients[g] = b[g] > 0.0 ? a[g] / b[g] : 0.0;
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

/// The fit's equations A, solved for the groups' right sides.
class GroupSolver {
 public:
  GroupSolver(const FitMesh& mesh, const VertexFit& fit, const NormalEquations& equations,
              const std::vector<SampleRecord>& records)
      : mesh_(mesh), fit_(fit), equations_(equations), records_(records) {}

  Deviations solve(const Deviations& right) const {
    return fit_.solve(equations_, right, errorGroups, roughly());
  }

  /// How far leaving each group out moves the fit: (A - M) x = score, with M what the group's records have in
  /// A. Solved by conjugate gradients with A as the preconditioner, since M is about an eighth of it; A times
  /// a direction follows from how the direction is made. `first` is solve(scores).
  Deviations withoutGroups(Deviations scores, const Deviations& first) const {
    constexpr int mostSteps = 5;
    constexpr double enough = 2e-3;  // of the energy is left, as expected from what the step before has left
    Deviations moved(scores.size(), 0.0f), direction = first, ofAll = scores;
    GroupSums energy = dots(scores, first);
    const double start = total(energy);
    bool last = false;
    for (int step = 1;; ++step) {
      {
        const Deviations image = imageOf(direction, ofAll);
        const GroupSums length = ratios(energy, dots(direction, image));
        combine(moved, filled(1.0), length, direction);
        combine(scores, filled(1.0), negative(length), image);
      }
      if (last || step == mostSteps) return moved;
      const Deviations rest = solve(scores);
      const GroupSums left = dots(scores, rest), turn = ratios(left, energy);
      combine(direction, turn, filled(1.0), rest);
      combine(ofAll, turn, filled(1.0), scores);
      last = total(left) * total(left) <= enough * start * total(energy);
      energy = left;
    }
  }

 private:
  /// (A - M) of, given A of.
  Deviations imageOf(const Deviations& of, Deviations ofAll) const {
    addRecords(
        mesh_, fit_, records_,
        [&](const SampleRecord& record, const auto& slots, const auto& b) {
          const auto value = [&](std::size_t k) { return of[slots[k] * errorGroups + record.group]; };
          return -(b[0] * value(0) + b[1] * value(1) + b[2] * value(2));
        },
        ofAll);
    return ofAll;
  }

  const FitMesh& mesh_;
  const VertexFit& fit_;
  const NormalEquations& equations_;
  const std::vector<SampleRecord>& records_;
};

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
                              const std::vector<SampleRecord>& records, std::uint64_t receivers,
                              bool independent) {
  constexpr double groups = errorGroups;
  const GroupSolver solver(mesh, all.fit, all.equations, records);
  Deviations scores = scoresOf(mesh, all.fit, records, all.values, all.columns);
  Deviations low = solver.solve(scores);
  const Deviations high =
      centred(solver.withoutGroups(std::move(scores), low), std::sqrt((groups - 1.0) / groups));
  low = centred(std::move(low), std::sqrt(groups / (groups - 1.0)));
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
