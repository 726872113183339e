#include "cast/side_sums.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/kept_work.h"
#include "base/spans.h"
#include "fit/vertex_fit.h"

namespace prelight {

namespace {

constexpr std::uint32_t plainRays = 512;  // around a slot, all alike, before fewer are cast there
constexpr float unseenShare = 0.01f;      // of its weight that a receiver inside a solid keeps

}  // namespace

bool isShare(float value) { return value >= -1e-3f && value <= 1.001f; }

SideSums::SideSums(const SideShape& side, const Schedule& schedule, HemisphereColumn& guide,
                   const std::vector<Column*>& columns, const SumMemory& memory)
    : side_(side),
      schedule_(schedule),
      areas_(*side.areas),
      guide_(guide),
      memory_(memory),
      records_(memory.recordBytes),
      seen_(side.mesh.slotCount(), 0),
      slotRays_(side.mesh.slotCount(), 0) {
  // With an error target, receivers crowd where it is not met yet.
  if (!schedule.error) side_.areas = nullptr;
  for (Column* column : columns) {
    const bool here = column->castFrom(side_.side);
    sums_.push_back(here ? column->makeSums(side_) : nullptr);
    blockedRays_ = blockedRays_ || (here && column->needs().blockedRays);
  }
}

void SideSums::park() {
  forAll([](ColumnSums& sums) { sums.park(); });
}

void SideSums::unpark() {
  forAll([](ColumnSums& sums) { sums.fetch(); });
}

void SideSums::add(SeenBlock& block) {
  weighUnseen(block);
  for (std::size_t c = 0; c < sums_.size(); ++c)
    if (sums_[c] && block.rows.columns[c].cast) sums_[c]->add(block);
  record(block);
  receivers_ += block.samples.size();
}

/// Keeps what the cast needs to know of receivers to go on: their accessibility.
void SideSums::record(const SeenBlock& block) {
  for (std::size_t i = 0; i < block.samples.size(); ++i) {
    askFor(block.samples, i);
    const float open = guide_.accessibility(block.rows, i);
    markSlots(block.samples[i], open);
    if (records_.size() < SampleRecords::most) records_.add({block.samples[i], open, block.group});
  }
}

// Nobody sees them, and what they see, which is nothing, would darken what is around. Their surface goes on
// to be smoothed: the vertices there take after those beside them.
void SideSums::weighUnseen(SeenBlock& block) {
  for (std::size_t i = 0; i < block.rows.inside.size(); ++i) {
    if (block.rows.inside[i] == 0) continue;
    if (!unseen_) {
      unseen_ = std::make_shared<std::vector<float>>(side_.mesh.triangles.size(), 0.0f);
      shareUnseen();
    }
    SurfaceSample& sample = block.samples[i];
    (*unseen_)[sample.triangle] += (1.0f - unseenShare) * sample.weight;
    sample.weight *= unseenShare;
  }
}

void SideSums::shareUnseen() {
  forAll([&](ColumnSums& sums) { sums.leaveOut(unseen_); });
}

void SideSums::limitTo(std::span<const std::uint8_t> triangles) {
  std::vector<std::uint8_t> slots(side_.mesh.slotCount(), 0);
  for (std::size_t t = 0; t < triangles.size(); ++t)
    for (const std::uint32_t slot : side_.mesh.triangles[t]) slots[slot] |= triangles[t];
  forAll([&](ColumnSums& sums) { sums.extendTo(slots); });
}

// Stiffens the fit of all values by what AO says: where that is flat, light is too, nearly always. An error
// to some percent does for that.
void SideSums::stiffen(const Progress& progress) {
  std::vector<double> stiffness(side_.mesh.slotCount());
  WorkPart part(progress, "stiffness", [&](auto& state) {
    state.sameSize(stiffness);
    state.requireFinite(stiffness);
    for (const double times : stiffness) state.require(times > 0.0);
  });
  if (!part.finished()) {
    const NormalEquations equations = fit().equations(defaultSmoothing);
    const std::vector<float> ao =
        fit().solveColumn(equations, 0, {.tolerance = 1e-4, .verified = false, .progress = &progress});
    ErrorEstimate error = errorOf(equations, ao, 1, 1, progress);
    for (double& slot : error.slots) slot = std::max(slot, schedule_.leastError);
    stiffness = stiffnessOf(side_.mesh, equations.laplacian(ao), error.slots);
    part.finish();
  }
  guideSums().fit().stiffen(std::move(stiffness));
}

// Samples after the i-th are added to values that lie anywhere in memory: prefetching them saves waiting.
void SideSums::askFor(std::span<const SurfaceSample> samples, std::size_t i) const {
  constexpr std::size_t trianglesAhead = 12, slotsAhead = 6;
  if (i + trianglesAhead < samples.size())
    prefetch(&side_.mesh.triangles[samples[i + trianglesAhead].triangle]);
  if (i + slotsAhead >= samples.size()) return;
  for (const std::uint32_t slot : side_.mesh.triangles[samples[i + slotsAhead].triangle]) {
    prefetch(&seen_[slot]);
    prefetch(&slotRays_[slot]);
  }
}

void SideSums::markSlots(const SurfaceSample& sample, double open) {
  for (const std::uint32_t slot : side_.mesh.triangles[sample.triangle]) {
    seen_[slot] |= static_cast<std::uint8_t>((open > 0.0 ? 1 : 0) | (open < 1.0 ? 2 : 0));
    slotRays_[slot] += std::min(schedule_.raysPerReceiver, ~slotRays_[slot]);
  }
}

bool SideSums::isPlain(std::size_t triangle) const {
  std::uint8_t seen = 0;
  for (const std::uint32_t slot : side_.mesh.triangles[triangle]) {
    seen |= seen_[slot];
    if (slotRays_[slot] < plainRays) return false;
  }
  return seen == 1 || (seen == 2 && !blockedRays_);
}

VertexFit SideSums::fitOf(std::size_t count) const {
  VertexFit part = emptyFit(side_, 1);
  part.stiffen(fit().stiffness());
  part.extendTo(fit().extent());
  part.leaveOut(unseen_);
  std::size_t left = count;
  records_.forAll([&](const SampleRecord& record) {
    if (left == 0) return;
    part.add(record.sample, std::array{double(record.open) - 1.0});
    --left;
  });
  return part;
}

FittedSide SideSums::solve(const Progress& progress) const {
  FittedSide fitted;
  fitted.values.resize(std::size_t{side_.mesh.slotCount()} * fit().columns());
  WorkPart part(progress, "fit", [&](auto& state) {
    state.sameSize(fitted.values);
    state.values(fitted.error.slots);
    state.value(fitted.error.rms);
    state.value(fitted.error.max);
    state.requireFinite(fitted.values);
    state.requireFinite(std::array{fitted.error.rms, fitted.error.max});
  });
  if (part.finished()) return fitted;
  const NormalEquations equations = fit().equations(defaultSmoothing);
  fitted.values = fit().solve(equations, {.progress = &progress});
  fitted.error =
      errorOf(equations, fitted.values, fit().columns(), ErrorEffort{}.stepsWithoutGroups, progress);
  part.finish();
  return fitted;
}

ErrorEstimate SideSums::estimateError(const Progress& progress) const {
  const NormalEquations equations = fit().equations(defaultSmoothing);
  return errorOf(equations, fit().solveColumn(equations, 0, {.progress = &progress}), 1,
                 ErrorEffort{}.stepsWithoutGroups, progress);
}

// Rays that all met the same say little of what they missed: of n that all escaped, the next is blocked with
// a probability whose posterior has a standard deviation of about 1 / (n + 2) (at 95 %, it is below 3 / n).
ErrorEstimate SideSums::errorOf(const NormalEquations& equations, std::span<const float> values,
                                std::size_t columns, int steps, const Progress& progress) const {
  const auto estimateOf = [&](const AoFit& all) {
    return estimateAoError(
        side_.mesh, all, areas_, records_, receivers_, schedule_.replicates > 1,
        {.halfOfTheGroups = memory_.parks, .stepsWithoutGroups = steps, .progress = &progress});
  };
  ErrorEstimate estimate;
  if (records_.size() == receivers_) {
    estimate = estimateOf({fit(), equations, values, columns});
  } else {
    const VertexFit recorded = fitOf(records_.size());
    const NormalEquations ofRecorded = recorded.equations(defaultSmoothing);
    estimate =
        estimateOf({recorded, ofRecorded, recorded.solveColumn(ofRecorded, 0, {.progress = &progress}), 1});
  }
  for (std::uint32_t s = 0; s < side_.mesh.slotCount(); ++s) {
    const bool used = side_.mesh.rowStart[s] < side_.mesh.rowStart[s + 1];
    if (used && seen_[s] != 3) estimate.slots[s] = std::max(estimate.slots[s], 1.0 / (slotRays_[s] + 2.0));
    estimate.max = std::max(estimate.max, estimate.slots[s]);
  }
  return estimate;
}

void SideSums::save(StateWriter& state) const {
  state.value(receivers_);
  records_.save(state);
  state.values(seen_);
  state.values(slotRays_);
  state.values(unseen_ ? *unseen_ : std::vector<float>());
  forAll([&](const ColumnSums& sums) { sums.save(state); });
}

void SideSums::load(StateReader& state, std::uint32_t stored) {
  state.value(receivers_);
  records_.load(state);
  state.sameSize(seen_);
  state.sameSize(slotRays_);
  std::vector<float> unseen;
  state.values(unseen);
  check(state);
  state.require(stored <= records_.size());
  state.require(unseen.empty() || unseen.size() == side_.mesh.triangles.size());
  state.requireFinite(unseen);
  forAll([&](ColumnSums& sums) { sums.load(state, {receivers_, records_.size(), stored}); });
  unseen_ = unseen.empty() ? nullptr : std::make_shared<std::vector<float>>(std::move(unseen));
  shareUnseen();
}

void SideSums::check(const StateReader& state) const {
  state.require(records_.size() == std::min<std::uint64_t>(receivers_, SampleRecords::most));
  records_.forAll([&](const SampleRecord& record) {
    const SurfaceSample& sample = record.sample;
    state.require(sample.triangle < side_.mesh.triangles.size() && record.group < errorGroups);
    state.require(isShare(sample.b1) && isShare(sample.b2) && isShare(record.open));
    state.require(std::isfinite(sample.weight) && sample.weight >= 0.0f);
  });
  for (const std::uint8_t seen : seen_) state.require(seen <= 3);
}

}  // namespace prelight
