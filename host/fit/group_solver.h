#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "base/kept_work.h"
#include "base/parallel.h"
#include "base/spans.h"
#include "fit/error_estimate.h"

namespace prelight {

/// Returns the fitted value: AO minus that of an unoccluded receiver.
inline double fittedValueOf(const SampleRecord& record) { return double(record.open) - 1.0; }

/// Solves the equations A of a fit for the right-hand sides of W groups of its records, from `firstGroup` on.
template <std::size_t W>
class GroupSolver {
 public:
  using Part = std::vector<float>;     ///< [slot][group]
  using Sums = std::array<double, W>;  ///< [group]

  GroupSolver(const FitMesh& mesh, const AoFit& all, const SampleRecords& records, std::uint32_t firstGroup,
              const Progress& progress)
      : mesh_(mesh), all_(all), records_(records), firstGroup_(firstGroup), progress_(progress) {}

  /// Returns the right-hand sides due to the residuals of each group alone, relative to the fit to all
  /// records.
  Part scores() const {
    Part scores(std::size_t{mesh_.slotCount()} * W, 0.0f);
    const auto fitted = [&](std::uint32_t slot) { return double(all_.values[slot * all_.columns]); };
    addRecords(
        [&](const SampleRecord& record, const auto& slots, const auto& b) {
          return fittedValueOf(record) -
                 (b[0] * fitted(slots[0]) + b[1] * fitted(slots[1]) + b[2] * fitted(slots[2]));
        },
        scores);
    return scores;
  }

  Part solve(Part right) const { return all_.fit.solve(all_.equations, std::move(right), W, roughly()); }

  /// Returns the change of the fit when each group is left out, which solves (A - M) x = score, where M is
  /// the part of A due to the group's records. Up to `mostSteps` conjugate gradients are taken with A as the
  /// preconditioner, since M is about an eighth of A; A times a direction follows from the way the direction
  /// is made. `first` is solve(scores). The result of a group depends on no other group.
  Part withoutGroups(Part scores, Part first, int mostSteps) const {
    Descent at{std::move(scores), std::move(first), {}, {}, {}, {}, {}, 1, false, false};
    at.ofAll = at.scores;
    at.moved.assign(at.scores.size(), 0.0f);
    at.start = at.energy = dots(at.scores, at.direction);
    WorkPart part(progress_, "groups left out", [&](auto& state) { exchange(state, at, mostSteps); });
    while (!at.ended) {
      at.wentOn ? turn(at) : goOn(at, mostSteps);
      part.advance();
    }
    part.finish();
    return std::move(at.moved);
  }

 private:
  using Marks = std::array<bool, W>;

  /// State of the conjugate gradients.
  struct Descent {
    Part scores, direction, ofAll, moved;
    Sums energy, start;
    Marks last;
    int step;
    bool wentOn;  ///< the step along the direction is done, and the direction is to be updated
    bool ended;
  };

  template <typename State>
  static void exchange(State& state, Descent& at, int mostSteps) {
    for (Part* part : {&at.scores, &at.direction, &at.ofAll, &at.moved}) state.sameSize(*part);
    state.value(at.energy);
    state.value(at.start);
    for (bool& last : at.last) state.value(last);
    state.value(at.step);
    state.value(at.wentOn);
    state.value(at.ended);
    state.require(at.step >= 1 && at.step <= mostSteps);
  }

  void goOn(Descent& at, int mostSteps) const {
    const Part image = imageOf(at.direction, at.ofAll);
    const Sums length = ratios(at.energy, dots(at.direction, image));
    combine(at.moved, filled(1.0), length, at.direction);
    combine(at.scores, notOf(at.last), negative(length), image);
    for (std::size_t g = 0; g < W; ++g)
      if (at.last[g]) at.energy[g] = 0.0;
    at.ended = at.step == mostSteps || at.energy == Sums{};
    at.wentOn = true;
  }

  void turn(Descent& at) const {
    constexpr double enough = 2e-3;  // share of the energy that may be left, predicted from the previous step
    const Part rest = solve(at.scores);
    const Sums left = dots(at.scores, rest), factor = ratios(left, at.energy);
    combine(at.direction, factor, filled(1.0), rest);
    combine(at.ofAll, factor, filled(1.0), at.scores);
    for (std::size_t g = 0; g < W; ++g) at.last[g] = left[g] * left[g] <= enough * at.start[g] * at.energy[g];
    at.energy = left;
    at.wentOn = false;
    ++at.step;
  }

  static constexpr std::size_t slotGrain = 4096;

  /// Returns limits for a precision of a percent, as the noise behind the deviations is not known any better.
  SolveLimits roughly() const {
    return {.tolerance = 1e-2, .iterations = 32, .verified = false, .progress = &progress_};
  }

  /// Returns the sums of a b over the slots, [group].
  static Sums dots(const Part& a, const Part& b) {
    std::vector<Sums> parts((a.size() / W + slotGrain - 1) / slotGrain, Sums{});
    parallelRanges(a.size() / W, slotGrain, [&](std::size_t begin, std::size_t end) {
      Sums& part = parts[begin / slotGrain];
      for (std::size_t i = begin * W; i < end * W; i += W)
        for (std::size_t g = 0; g < W; ++g) part[g] += double(a[i + g]) * b[i + g];
    });
    Sums sums{};
    for (const Sums& part : parts)
      for (std::size_t g = 0; g < W; ++g) sums[g] += part[g];
    return sums;
  }

  /// Sets a = factor[group] a + more[group] b.
  static void combine(Part& a, const Sums& factor, const Sums& more, const Part& b) {
    parallelRanges(a.size() / W, slotGrain, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin * W; i < end * W; i += W)
        for (std::size_t g = 0; g < W; ++g)
          a[i + g] = static_cast<float>(factor[g] * a[i + g] + more[g] * b[i + g]);
    });
  }

  static Sums ratios(const Sums& a, const Sums& b) {
    Sums quotients{};
    for (std::size_t g = 0; g < W; ++g) quotients[g] = b[g] > 0.0 ? a[g] / b[g] : 0.0;
    return quotients;
  }

  static Sums filled(double value) {
    Sums sums;
    sums.fill(value);
    return sums;
  }

  static Sums negative(Sums sums) {
    for (double& sum : sums) sum = -sum;
    return sums;
  }

  /// Returns 0 where marked, else 1.
  static Sums notOf(const Marks& marks) {
    Sums sums;
    for (std::size_t g = 0; g < W; ++g) sums[g] = marks[g] ? 0.0 : 1.0;
    return sums;
  }

  /// Adds each record's weight times its value to its three slots, in the column of its group. Groups are
  /// distributed to threads.
  template <typename Value>
  void addRecords(const Value& value, Part& sums) const {
    const std::size_t grain = std::max<std::size_t>(1, W / hardwareThreads());
    parallelRanges(W, grain, [&](std::size_t begin, std::size_t end) {
      const std::size_t first = firstGroup_ + begin, last = firstGroup_ + end;
      records_.forBlocks(static_cast<std::uint32_t>(first), static_cast<std::uint32_t>(last),
                         [&](std::span<const SampleRecord> block) {
                           for (std::size_t i = 0; i < block.size(); ++i) {
                             askFor(block, i, sums);
                             if (block[i].group >= first && block[i].group < last) add(block[i], value, sums);
                           }
                         });
    });
  }

  /// Prefetches the sums that later records are added to, as they are scattered in memory.
  void askFor(std::span<const SampleRecord> block, std::size_t i, const Part& sums) const {
    constexpr std::size_t trianglesAhead = 16, slotsAhead = 8;
    if (i + trianglesAhead < block.size())
      prefetch(&mesh_.triangles[block[i + trianglesAhead].sample.triangle]);
    if (i + slotsAhead >= block.size()) return;
    for (const std::uint32_t slot : mesh_.triangles[block[i + slotsAhead].sample.triangle])
      prefetch(&sums[std::size_t{slot} * W], W);
  }

  template <typename Value>
  void add(const SampleRecord& record, const Value& value, Part& sums) const {
    const auto& slots = mesh_.triangles[record.sample.triangle];
    const auto b = cornerWeights(record.sample);
    const double weighted = all_.fit.weightOf(record.sample) * value(record, slots, b);
    for (std::size_t k = 0; k < 3; ++k)
      sums[placeOf(slots[k], record)] += static_cast<float>(b[k] * weighted);
  }

  std::size_t placeOf(std::uint32_t slot, const SampleRecord& record) const {
    return std::size_t{slot} * W + record.group - firstGroup_;
  }

  /// Returns (A - M) of, given A of.
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
  const Progress& progress_;
};

}  // namespace prelight
