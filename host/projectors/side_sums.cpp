#include "projectors/side_sums.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/kept_work.h"
#include "base/prefetch.h"
#include "basis/sh_zonal.h"
#include "fit/adaptive_smoothing.h"

namespace prelight {

namespace {

constexpr std::uint32_t plainRays = 512;       // around a slot, all alike, before fewer are cast there
constexpr float unseenShare = 0.01f;           // of its weight that a receiver inside a solid keeps
constexpr double bentNormalHalfWeight = 0.05;  // mean open vector of 64 rays is known to about 0.02

/// Of a shell.
std::size_t shellColumns(const Projections& projections) {
  return static_cast<std::size_t>(projections.shellOrder * projections.shellOrder);
}

/// Of what comes by mirrors and glass, in three channels.
std::size_t specularColumns(const Projections& projections) {
  return 3 * static_cast<std::size_t>(projections.specularOrder * projections.specularOrder);
}

}  // namespace

bool isShare(float value) { return value >= -1e-3f && value <= 1.001f; }

SideSums::SideSums(const CompiledScene& scene, const FitMesh& mesh, const Schedule& schedule,
                   const Projections& projections, Baseline baseline, const std::vector<double>& areas)
    : scene_(scene),
      mesh_(mesh),
      schedule_(schedule),
      projections_(projections),
      areas_(areas),
      baseline_(std::move(baseline)),
      fit_(plainFit(baseline_.columns())),
      records_(projections.recordBytes),
      seen_(mesh.slotCount(), 0),
      slotRays_(mesh.slotCount(), 0),
      residual_(baseline_.columns()) {
  if (projections_.bentNormal) bentFit_.emplace(plainFit(3));
  if (projections_.groups > 0) lightFit_.emplace(plainFit(3 * projections_.groups));
  if (projections_.shells > 0) shellFit_.emplace(plainFit(projections_.shells * shellColumns(projections_)));
  if (projections_.specularOrder > 0) specularFit_.emplace(plainFit(specularColumns(projections_)));
  if (projections_.sectors > 0) sectorFit_.emplace(plainFit(sectorRows * projections_.sectors));
  if (projections_.occluders) occluders_.emplace(mesh);
}

void SideSums::park() {
  fit_.park();
  forFurtherFits([](VertexFit& fit) { fit.park(); });
}

void SideSums::unpark() {
  fit_.fetch();
  forFurtherFits([](VertexFit& fit) { fit.fetch(); });
}

void SideSums::add(CastBlock& block) {
  weighUnseen(block);
  rows_.clear();
  bentSamples_.clear();
  bentRows_.clear();
  for (std::size_t i = 0; i < block.samples.size(); ++i) {
    askFor(block.samples, i);
    addReceiver(block, i);
  }
  fit_.add(block.samples, rows_);
  if (bentFit_) bentFit_->add(bentSamples_, bentRows_);
  addFurther(lightFit_, block, block.values.lights);
  addFurther(specularFit_, block, block.values.specular);
  if (shellFit_) addShells(block);
  if (sectorFit_) addSectors(block);
  receivers_ += block.samples.size();
}

void SideSums::addFurther(std::optional<VertexFit>& fit, const CastBlock& block,
                          const std::vector<float>& values) {
  if (!fit) return;
  furtherRows_.assign(values.begin(), values.end());
  fit->add(block.samples, furtherRows_);
}

// Nobody sees them, and what they see, which is nothing, would darken what is around. Their surface goes on
// to be smoothed: the vertices there take after those beside them.
void SideSums::weighUnseen(CastBlock& block) {
  for (std::size_t i = 0; i < block.values.inside.size(); ++i) {
    if (block.values.inside[i] == 0) continue;
    if (!unseen_) {
      unseen_ = std::make_shared<std::vector<float>>(mesh_.triangles.size(), 0.0f);
      shareUnseen();
    }
    SurfaceSample& sample = block.samples[i];
    (*unseen_)[sample.triangle] += (1.0f - unseenShare) * sample.weight;
    sample.weight *= unseenShare;
  }
}

void SideSums::shareUnseen() {
  fit_.leaveOut(unseen_);
  forFurtherFits([&](VertexFit& fit) { fit.leaveOut(unseen_); });
}

void SideSums::limitTo(std::span<const std::uint8_t> triangles) {
  std::vector<std::uint8_t> slots(mesh_.slotCount(), 0);
  for (std::size_t t = 0; t < triangles.size(); ++t)
    for (const std::uint32_t slot : mesh_.triangles[t]) slots[slot] |= triangles[t];
  if (lightFit_) lightFit_->extendTo(slots);
  if (shellFit_) shellFit_->extendTo(slots);
  if (specularFit_) specularFit_->extendTo(slots);
  if (sectorFit_) sectorFit_->extendTo(slots);
  fit_.extendTo(std::move(slots));
}

// Stiffens the fit of all values by what AO says: where that is flat, light is too, nearly always. An error
// to some percent does for that.
void SideSums::stiffen(const Progress& progress) {
  std::vector<double> stiffness(mesh_.slotCount());
  WorkPart part(progress, "stiffness", [&](auto& state) {
    state.sameSize(stiffness);
    state.requireFinite(stiffness);
    for (const double times : stiffness) state.require(times > 0.0);
  });
  if (!part.finished()) {
    const NormalEquations equations = fit_.equations(defaultSmoothing);
    const std::vector<float> ao =
        fit_.solveColumn(equations, 0, {.tolerance = 1e-4, .verified = false, .progress = &progress});
    const ErrorEstimate error = errorOf(equations, ao, 1, 1, progress);
    stiffness = stiffnessOf(mesh_, equations.laplacian(ao), error.slots);
    part.finish();
  }
  fit_.stiffen(std::move(stiffness));
}

// What samples after the i-th are added to lies anywhere in memory, and would be waited for.
void SideSums::askFor(std::span<const SurfaceSample> samples, std::size_t i) const {
  constexpr std::size_t trianglesAhead = 12, slotsAhead = 6;
  if (i + trianglesAhead < samples.size()) prefetch(&mesh_.triangles[samples[i + trianglesAhead].triangle]);
  if (i + slotsAhead >= samples.size()) return;
  for (const std::uint32_t slot : mesh_.triangles[samples[i + slotsAhead].triangle]) {
    baseline_.prefetchRow(slot);
    prefetch(&seen_[slot]);
    prefetch(&slotRays_[slot]);
  }
}

// The kernel's values are those of the blocked part; what an open hemisphere has is added in closed form,
// then the interpolated baseline is taken off, so that the fit sees only what occlusion changes.
void SideSums::addReceiver(const CastBlock& block, std::size_t i) {
  const SurfaceSample& sample = block.samples[i];
  const device::Receiver& receiver = block.receivers[i];
  const std::size_t valueCount = block.values.values.size() / block.samples.size();
  const float* values = &block.values.values[i * valueCount];
  const double open = values[0];
  const glm::dvec3 normal(receiver.normal[0], receiver.normal[1], receiver.normal[2]);
  baseline_.evaluate(normal, residual_.data());
  const auto& slots = mesh_.triangles[sample.triangle];
  const double b1 = sample.b1, b2 = sample.b2, b0 = 1.0 - b1 - b2;
  const auto interpolated = [&](std::size_t c) {
    return b0 * baseline_.value(slots[0], c) + b1 * baseline_.value(slots[1], c) +
           b2 * baseline_.value(slots[2], c);
  };
  residual_[0] = open - 1.0;
  for (std::size_t c = 1; c < residual_.size(); ++c)
    residual_[c] = double(values[3 + c]) + open * residual_[c] - interpolated(c);
  rows_.insert(rows_.end(), residual_.begin(), residual_.end());
  // The mean direction under the density cos/pi is 2/3 of the normal where all is open.
  if (bentFit_)
    addBentNormal(sample, glm::dvec3(values[1], values[2], values[3]) + open * 2.0 / 3.0 * normal);
  if (block.occluders) occluders_.value().add(sample, receiver, block.values.occluders, i);
  markSlots(sample, open);
  if (records_.size() == mostRecords) return;
  records_.add({sample, values[0], block.group});
  if (projections_.texelRows > 0)
    texelRows_.add(
        std::span(block.values.texels).subspan(i * schedule_.raysPerReceiver, schedule_.raysPerReceiver),
        projections_.texelRows);
}

// Directions are fitted, not the mean vectors that they come from: otherwise what is bright at one corner of
// a triangle would turn the normal at a dark one. The less is open, the less a direction is worth; nothing
// open has none.
void SideSums::addBentNormal(const SurfaceSample& sample, const glm::dvec3& meanOpen) {
  const double length = glm::length(meanOpen);
  if (length < 1e-6) return;
  const auto& t = scene_.triangles[sample.triangle];
  const double b1 = sample.b1, b2 = sample.b2;
  const glm::dvec3 interpolated = (1.0 - b1 - b2) * glm::dvec3(scene_.normals[t.x]) +
                                  b1 * glm::dvec3(scene_.normals[t.y]) + b2 * glm::dvec3(scene_.normals[t.z]);
  const glm::dvec3 residual = meanOpen / length - interpolated;
  SurfaceSample weighted = sample;
  weighted.weight *=
      static_cast<float>(length * length / (length * length + bentNormalHalfWeight * bentNormalHalfWeight));
  bentSamples_.push_back(weighted);
  bentRows_.insert(bentRows_.end(), {residual.x, residual.y, residual.z});
}

// As addReceiver() does with what is open: the closed form times a shell's share of the hemisphere is added.
void SideSums::addShells(const CastBlock& block) {
  const std::size_t columns = shellColumns(projections_), rows = block.samples.size() * projections_.shells;
  std::vector<double> open(columns);
  shellRows_.resize(rows * columns);
  for (std::size_t row = 0; row < rows; ++row) {
    if (row % projections_.shells == 0) {
      const float* normal = block.receivers[row / projections_.shells].normal;
      sh::openTransfer({normal[0], normal[1], normal[2]}, projections_.shellOrder, open);
    }
    const float* values = &block.values.shells[row * (1 + columns)];
    for (std::size_t i = 0; i < columns; ++i)
      shellRows_[row * columns + i] = double(values[1 + i]) + double(values[0]) * open[i];
  }
  shellFit_->add(block.samples, shellRows_);
}

// What is open less 1: of receivers that see nothing all rows are 0 then, which is exact.
void SideSums::addSectors(const CastBlock& block) {
  furtherRows_.assign(block.values.sectors.begin(), block.values.sectors.end());
  for (std::size_t i = 0; i < furtherRows_.size(); ++i)
    if (i / projections_.sectors % sectorRows == 1) furtherRows_[i] -= 1.0;
  sectorFit_->add(block.samples, furtherRows_);
}

void SideSums::markSlots(const SurfaceSample& sample, double open) {
  for (const std::uint32_t slot : mesh_.triangles[sample.triangle]) {
    seen_[slot] |= static_cast<std::uint8_t>((open > 0.0 ? 1 : 0) | (open < 1.0 ? 2 : 0));
    slotRays_[slot] += std::min(schedule_.raysPerReceiver, ~slotRays_[slot]);
  }
}

bool SideSums::isPlain(std::size_t triangle, bool closedToo) const {
  std::uint8_t seen = 0;
  for (const std::uint32_t slot : mesh_.triangles[triangle]) {
    seen |= seen_[slot];
    if (slotRays_[slot] < plainRays) return false;
  }
  return seen == 1 || (seen == 2 && closedToo);
}

// With an error target, receivers crowd where it is not met yet.
VertexFit SideSums::plainFit(std::size_t columns) const {
  return schedule_.error ? VertexFit(mesh_, columns, areas_) : VertexFit(mesh_, columns);
}

VertexFit SideSums::fitOf(std::size_t count) const {
  VertexFit fit = plainFit(1);
  fit.stiffen(fit_.stiffness());
  fit.extendTo(fit_.extent());
  fit.leaveOut(unseen_);
  std::size_t left = count;
  records_.forAll([&](const SampleRecord& record) {
    if (left == 0) return;
    fit.add(record.sample, std::array{double(record.open) - 1.0});
    --left;
  });
  return fit;
}

FittedSide SideSums::solve(const Progress& progress) const {
  FittedSide fitted;
  fitted.values.resize(std::size_t{mesh_.slotCount()} * fit_.columns());
  WorkPart part(progress, "fit", [&](auto& state) {
    state.sameSize(fitted.values);
    state.values(fitted.error.slots);
    state.value(fitted.error.rms);
    state.value(fitted.error.max);
    state.requireFinite(fitted.values);
    state.requireFinite(std::array{fitted.error.rms, fitted.error.max});
  });
  if (part.finished()) return fitted;
  const NormalEquations equations = fit_.equations(defaultSmoothing);
  fitted.values = fit_.solve(equations, {.progress = &progress});
  fitted.error =
      errorOf(equations, fitted.values, fit_.columns(), ErrorEffort{}.stepsWithoutGroups, progress);
  part.finish();
  return fitted;
}

ErrorEstimate SideSums::estimateError(const Progress& progress) const {
  const NormalEquations equations = fit_.equations(defaultSmoothing);
  return errorOf(equations, fit_.solveColumn(equations, 0, {.progress = &progress}), 1,
                 ErrorEffort{}.stepsWithoutGroups, progress);
}

// Rays that all met the same say little of what they missed: of n that all escaped, the next is blocked with
// a probability whose posterior has a standard deviation of about 1 / (n + 2) (at 95 %, it is below 3 / n).
ErrorEstimate SideSums::errorOf(const NormalEquations& equations, std::span<const float> values,
                                std::size_t columns, int steps, const Progress& progress) const {
  const auto estimateOf = [&](const AoFit& fit) {
    return estimateAoError(
        mesh_, fit, areas_, records_, receivers_, schedule_.replicates > 1,
        {.halfOfTheGroups = projections_.parks, .stepsWithoutGroups = steps, .progress = &progress});
  };
  ErrorEstimate estimate;
  if (records_.size() == receivers_) {
    estimate = estimateOf({fit_, equations, values, columns});
  } else {
    const VertexFit recorded = fitOf(records_.size());
    const NormalEquations ofRecorded = recorded.equations(defaultSmoothing);
    estimate =
        estimateOf({recorded, ofRecorded, recorded.solveColumn(ofRecorded, 0, {.progress = &progress}), 1});
  }
  for (std::uint32_t s = 0; s < mesh_.slotCount(); ++s) {
    const bool used = mesh_.rowStart[s] < mesh_.rowStart[s + 1];
    if (used && seen_[s] != 3) estimate.slots[s] = std::max(estimate.slots[s], 1.0 / (slotRays_[s] + 2.0));
    estimate.max = std::max(estimate.max, estimate.slots[s]);
  }
  return estimate;
}

void SideSums::save(StateWriter& state) const {
  fit_.save(state);
  if (bentFit_) bentFit_->save(state);
  if (lightFit_) lightFit_->save(state);
  if (shellFit_) shellFit_->save(state);
  if (specularFit_) specularFit_->save(state);
  if (sectorFit_) sectorFit_->save(state);
  if (occluders_) occluders_->save(state);
  texelRows_.save(state);
  records_.save(state);
  state.values(seen_);
  state.values(slotRays_);
  state.value(receivers_);
  state.values(unseen_ ? *unseen_ : std::vector<float>());
}

void SideSums::load(StateReader& state) {
  fit_.load(state);
  forFurtherFits([&](VertexFit& fit) { fit.load(state); });
  if (occluders_) occluders_->load(state, projections_.occluderCount);
  texelRows_.load(state);
  records_.load(state);
  state.sameSize(seen_);
  state.sameSize(slotRays_);
  state.value(receivers_);
  std::vector<float> unseen;
  state.values(unseen);
  state.require(unseen.empty() || unseen.size() == mesh_.triangles.size());
  state.requireFinite(unseen);
  unseen_ = unseen.empty() ? nullptr : std::make_shared<std::vector<float>>(std::move(unseen));
  shareUnseen();
  check(state);
}

void SideSums::check(const StateReader& state) const {
  state.require(records_.size() == std::min<std::uint64_t>(receivers_, mostRecords));
  texelRows_.check(state, projections_.texelRows > 0 ? records_.size() : 0, schedule_.raysPerReceiver,
                   projections_.texelCount);
  records_.forAll([&](const SampleRecord& record) {
    const SurfaceSample& sample = record.sample;
    state.require(sample.triangle < mesh_.triangles.size() && record.group < errorGroups);
    state.require(isShare(sample.b1) && isShare(sample.b2) && isShare(record.open));
    state.require(std::isfinite(sample.weight) && sample.weight >= 0.0f);
  });
  for (const std::uint8_t seen : seen_) state.require(seen <= 3);
}

}  // namespace prelight
