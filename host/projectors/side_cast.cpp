#include "projectors/side_cast.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numeric>

#include "fit/adaptive_smoothing.h"

namespace prelight {

namespace {

constexpr std::uint32_t plainRays = 512;       // around a slot, all alike, before fewer are cast there
constexpr double bentNormalHalfWeight = 0.05;  // mean open vector of 64 rays is known to about 0.02
constexpr double leastReceivers = 4.0;         // of a component, in the first round
constexpr std::size_t maxRecords = std::size_t{1} << 24;  // 400 MB; an error target gives up there

/// In [0,1], but for rounding.
bool isShare(float value) { return value >= -1e-3f && value <= 1.001f; }

}  // namespace

SideCast::SideCast(const CompiledScene& scene, const FitMesh& mesh, Caster& caster, const Schedule& schedule,
                   const Projections& projections, Side side)
    : scene_(scene),
      mesh_(mesh),
      caster_(caster),
      schedule_(schedule),
      projections_(projections),
      sampler_(scene, schedule.seed, side, schedule.replicates),
      baseline_(scene, mesh, projections.shOrder, side == Side::Front ? 1.0 : -1.0),
      fit_(plainFit(baseline_.columns())),
      seen_(mesh.slotCount(), 0),
      slotRays_(mesh.slotCount(), 0),
      residual_(baseline_.columns()) {
  sampler_.coverComponents(mesh, schedule.receiversPerPass * schedule.passes, leastReceivers);
  if (side == Side::Back) {
    projections_.bentNormal = projections_.receivers = projections_.occluders = false;
    projections_.texelRows = 0;
  }
  if (projections_.bentNormal) bentFit_.emplace(plainFit(3));
  if (projections_.groups > 0) lightFit_.emplace(plainFit(3 * projections_.groups));
  if (projections_.occluders) occluders_.emplace(mesh);
}

void SideCast::start() {
  running_ = true;
  round_ = passInRound_ = 0;
  fit_.stiffen({});
  receiversPerPass_ = schedule_.receiversPerPass;
}

void SideCast::run(Progress& progress, std::uint32_t storedFirst, std::uint32_t storedCapacity) {
  storedFirst_ = storedFirst;
  storedCapacity_ = storedCapacity;
  if (!running_) start();
  for (bool ended = false; !ended;) {
    for (; passInRound_ < schedule_.passes; ++passInRound_) {
      // The first round is owed: without it, there would be nothing to fit.
      if (round_ > 0 && schedule_.deadline && std::chrono::steady_clock::now() >= *schedule_.deadline) break;
      castPass(progress);
      thinPlainTriangles();
    }
    ended = passInRound_ < schedule_.passes || endRound();
  }
  stiffen();
  running_ = false;
}

// Stiffens the fit of all values by what AO says: where that is flat, light is too, nearly always.
void SideCast::stiffen() {
  std::vector<double> laplacian(mesh_.slotCount());
  fit_.equations(defaultSmoothing).laplacian(fit_.solveColumn(defaultSmoothing, 0), laplacian, 1);
  fit_.stiffen(stiffnessOf(mesh_, laplacian, estimateError().slots));
}

// True when the schedule is fulfilled.
bool SideCast::endRound() {
  if (schedule_.error) {
    if (dropAccurateTriangles() == 0 || round_ == schedule_.maxDoublings || records_.size() == maxRecords)
      return true;
    if (round_ > 0) receiversPerPass_ *= 2.0;  // every round doubles what its triangles have had
  } else if (!schedule_.deadline) {
    return true;
  }
  ++round_;
  passInRound_ = 0;
  return false;
}

// A pass that was interrupted is walked again, without what has been cast of it.
void SideCast::castPass(Progress& progress) {
  if (!inPass_) {
    passStart_ = sampler_.position();
    doneInPass_ = 0;
    inPass_ = true;
  }
  sampler_.restore(passStart_);
  const auto flushAndReport = [&] {
    flush();
    progress.check();
  };
  std::uint64_t known = doneInPass_;
  sampler_.pass(receiversPerPass_, schedule_.raysPerReceiver,
                [&](const SurfaceSample& sample, const device::Receiver& receiver) {
                  if (known > 0) {
                    --known;
                    return;
                  }
                  pendingSamples_.push_back(sample);
                  pendingReceivers_.push_back(receiver);
                  if (pendingReceivers_.size() == caster_.blockSize()) flushAndReport();
                });
  flushAndReport();
  inPass_ = false;
  ++pass_;
  if (projections_.occluders && std::has_single_bit(pass_)) estimateAccessibility();
  if (!schedule_.deadline && !schedule_.error) progress.report("cast", double(pass_) / schedule_.passes);
}

// What occluders send is damped by their AO (Sherif 2013, 7.2.4), so that the first pass is for AO alone, and
// those after it have the more of it the later they are.
void SideCast::estimateAccessibility() {
  const std::vector<double> blocked = fit_.solveColumn(defaultSmoothing, 0);
  accessibility_.resize(scene_.vertexCount());
  for (std::uint32_t v = 0; v < scene_.vertexCount(); ++v)
    accessibility_[v] = static_cast<float>(std::clamp(1.0 + blocked[mesh_.slotOfVertex[v]], 0.0, 1.0));
  caster_.setAccessibility(scene_, accessibility_);
}

std::uint32_t SideCast::setOf(const SurfaceSample& sample) const {
  return projections_.sets != nullptr ? projections_.sets->setOf(sample.triangle) : 0;
}

void SideCast::sortPendingBySet() {
  std::vector<std::size_t> order(pendingSamples_.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return setOf(pendingSamples_[a]) < setOf(pendingSamples_[b]);
  });
  const auto samples = pendingSamples_;
  const auto receivers = pendingReceivers_;
  for (std::size_t i = 0; i < order.size(); ++i) {
    pendingSamples_[i] = samples[order[i]];
    pendingReceivers_[i] = receivers[order[i]];
  }
}

// A block is whole again at the end, whichever sets its receivers are of: an interrupted pass goes on there.
void SideCast::flush() {
  if (projections_.sets != nullptr && !projections_.sets->empty()) sortPendingBySet();
  for (std::size_t first = 0; first < pendingReceivers_.size();) {
    const std::uint32_t set = setOf(pendingSamples_[first]);
    std::size_t end = first + 1;
    while (end < pendingSamples_.size() && setOf(pendingSamples_[end]) == set) ++end;
    castBlock(first, static_cast<std::uint32_t>(end - first), set);
    first = end;
  }
  pendingSamples_.clear();
  pendingReceivers_.clear();
}

void SideCast::castBlock(std::size_t first, std::uint32_t count, std::uint32_t set) {
  const auto receivers = std::span(pendingReceivers_).subspan(first, count);
  const std::uint32_t row = storedFirst_ + storedCount_;
  // Bounces read the records of stored rows, so a row is kept only where its record is.
  const bool stores = storedCount_ + count <= storedCapacity_ && storedCount_ == receivers_ &&
                      receivers_ + count <= maxRecords;
  caster_.cast(receivers, values_, {stores ? &row : nullptr, set, !accessibility_.empty()});
  if (stores) storedCount_ += count;
  if (stores && projections_.receivers)
    storedReceivers_.insert(storedReceivers_.end(), receivers.begin(), receivers.end());
  for (std::size_t i = 0; i < count; ++i) addReceiver(first + i, i);
  receivers_ += count;
  doneInPass_ += count;
}

// The kernel's values are those of the blocked part; what an open hemisphere has is added in closed form,
// then the interpolated baseline is taken off, so that the fit sees only what occlusion changes.
void SideCast::addReceiver(std::size_t pending, std::size_t i) {
  const SurfaceSample& sample = pendingSamples_[pending];
  const device::Receiver& receiver = pendingReceivers_[pending];
  const float* values = &values_.values[i * caster_.valueCount()];
  const double open = values[0];
  const glm::dvec3 normal(receiver.normal[0], receiver.normal[1], receiver.normal[2]);
  baseline_.evaluate(normal, residual_.data());
  const auto& slots = mesh_.triangles[sample.triangle];
  const double b1 = sample.b1, b2 = sample.b2, b0 = 1.0 - b1 - b2;
  const double *r0 = baseline_.row(slots[0]), *r1 = baseline_.row(slots[1]), *r2 = baseline_.row(slots[2]);
  residual_[0] = open - 1.0;
  for (std::size_t c = 1; c < residual_.size(); ++c)
    residual_[c] = double(values[3 + c]) + open * residual_[c] - (b0 * r0[c] + b1 * r1[c] + b2 * r2[c]);
  fit_.add(sample, residual_);
  // The mean direction under the density cos/pi is 2/3 of the normal where all is open.
  if (bentFit_)
    addBentNormal(sample, glm::dvec3(values[1], values[2], values[3]) + open * 2.0 / 3.0 * normal);
  if (lightFit_) addLights(sample, i);
  if (!accessibility_.empty()) occluders_->add(sample, receiver, values_.occluders, i);
  markSlots(sample, open);
  if (records_.size() == maxRecords) return;
  records_.push_back({sample, values[0], pass_ % errorGroups});
  const std::size_t rays = caster_.raysPerReceiver();
  if (projections_.texelRows > 0)
    texelRows_.add(std::span(values_.texels).subspan(i * rays, rays), projections_.texelRows);
}

void SideCast::addLights(const SurfaceSample& sample, std::size_t i) {
  const std::size_t columns = lightFit_->columns();
  lightRow_.assign(values_.lights.begin() + static_cast<std::ptrdiff_t>(i * columns),
                   values_.lights.begin() + static_cast<std::ptrdiff_t>((i + 1) * columns));
  lightFit_->add(sample, lightRow_);
}

// Directions are fitted, not the mean vectors that they come from: otherwise what is bright at one corner of
// a triangle would turn the normal at a dark one. The less is open, the less a direction is worth; nothing
// open has none.
void SideCast::addBentNormal(const SurfaceSample& sample, const glm::dvec3& meanOpen) {
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
  bentFit_->add(weighted, std::span(&residual.x, 3));
}

void SideCast::markSlots(const SurfaceSample& sample, double open) {
  for (const std::uint32_t slot : mesh_.triangles[sample.triangle]) {
    seen_[slot] |= static_cast<std::uint8_t>((open > 0.0 ? 1 : 0) | (open < 1.0 ? 2 : 0));
    slotRays_[slot] += std::min(schedule_.raysPerReceiver, ~slotRays_[slot]);
  }
}

// Where every ray around escaped, the closed form is most likely the answer, and where every one was blocked,
// 0. A few more rays are cast there all the same, each for many: were there none, what the first rays missed
// would be missed on average, too. Blocked rays carry light in bounces, so that those are thinned only
// without.
void SideCast::thinPlainTriangles() {
  for (std::size_t t = 0; t < mesh_.triangles.size(); ++t) {
    std::uint8_t seen = 0;
    bool enough = true;
    for (const std::uint32_t slot : mesh_.triangles[t]) {
      seen |= seen_[slot];
      enough = enough && slotRays_[slot] >= plainRays;
    }
    sampler_.thinned()[t] = enough && (seen == 1 || (seen == 2 && storedCapacity_ == 0));
  }
}

// A slot's value hangs through the fit on the samples around its neighbours, so those are refined with it.
std::size_t SideCast::dropAccurateTriangles() {
  const ErrorEstimate estimate = estimateError();
  std::vector<std::uint8_t> wanted(mesh_.slotCount(), 0);
  for (std::uint32_t s = 0; s < mesh_.slotCount(); ++s) wanted[s] = estimate.slots[s] > *schedule_.error;
  for (int ring = 0; ring < 2; ++ring) {
    const std::vector<std::uint8_t> inner = wanted;
    for (std::uint32_t s = 0; s < mesh_.slotCount(); ++s)
      for (std::uint32_t e = mesh_.rowStart[s]; inner[s] && e < mesh_.rowStart[s + 1]; ++e)
        wanted[mesh_.columns[e]] = 1;
  }
  auto& active = sampler_.active();
  std::size_t left = 0;
  for (std::size_t t = 0; t < active.size(); ++t) {
    const auto& slots = mesh_.triangles[t];
    active[t] = wanted[slots[0]] || wanted[slots[1]] || wanted[slots[2]];
    left += active[t];
  }
  return left;
}

// With an error target, receivers crowd where it is not met yet.
VertexFit SideCast::plainFit(std::size_t columns) const {
  return schedule_.error ? VertexFit(mesh_, columns, sampler_.areas()) : VertexFit(mesh_, columns);
}

VertexFit SideCast::emptyFit(std::size_t columns) const {
  VertexFit fit = plainFit(columns);
  fit.stiffen(fit_.stiffness());
  return fit;
}

// Rays that all met the same say little of what they missed: of n that all escaped, the next is blocked with
// a probability whose posterior has a standard deviation of about 1 / (n + 2) (at 95 %, it is below 3 / n).
ErrorEstimate SideCast::estimateError() const {
  ErrorEstimate estimate =
      estimateAoError(mesh_, emptyFit(1), sampler_.areas(), records_, receivers_, schedule_.replicates > 1);
  for (std::uint32_t s = 0; s < mesh_.slotCount(); ++s) {
    const bool used = mesh_.rowStart[s] < mesh_.rowStart[s + 1];
    if (used && seen_[s] != 3) estimate.slots[s] = std::max(estimate.slots[s], 1.0 / (slotRays_[s] + 2.0));
    estimate.max = std::max(estimate.max, estimate.slots[s]);
  }
  return estimate;
}

void SideCast::save(StateWriter& state) const {
  fit_.save(state);
  if (bentFit_) bentFit_->save(state);
  if (lightFit_) lightFit_->save(state);
  if (occluders_) occluders_->save(state);
  state.values(accessibility_);
  texelRows_.save(state);
  state.values(storedReceivers_);
  state.values(records_);
  state.values(seen_);
  state.values(slotRays_);
  state.values(sampler_.active());
  state.values(sampler_.thinned());
  const SurfaceSampler::Position& position = inPass_ ? passStart_ : sampler_.position();
  state.values(position.taken);
  state.value(position.passes);
  state.value(storedFirst_);
  state.value(storedCount_);
  state.value(receivers_);
  state.value(pass_);
  state.value(running_);
  state.value(round_);
  state.value(passInRound_);
  state.value(receiversPerPass_);
  state.value(inPass_);
  state.value(doneInPass_);
}

void SideCast::load(StateReader& state) {
  fit_.load(state);
  if (bentFit_) bentFit_->load(state);
  if (lightFit_) lightFit_->load(state);
  if (occluders_) occluders_->load(state, projections_.occluderCount);
  state.values(accessibility_);
  texelRows_.load(state);
  state.values(storedReceivers_);
  state.values(records_);
  state.sameSize(seen_);
  state.sameSize(slotRays_);
  state.sameSize(sampler_.active());
  state.sameSize(sampler_.thinned());
  passStart_ = sampler_.position();
  state.sameSize(passStart_.taken);
  state.value(passStart_.passes);
  sampler_.restore(passStart_);
  state.value(storedFirst_);
  state.value(storedCount_);
  state.value(receivers_);
  state.value(pass_);
  state.value(running_);
  state.value(round_);
  state.value(passInRound_);
  state.value(receiversPerPass_);
  state.value(inPass_);
  state.value(doneInPass_);
  checkSchedule(state);
  checkReceivers(state);
  if (!accessibility_.empty()) caster_.setAccessibility(scene_, accessibility_);
}

/// What was read of where the schedule stands.
void SideCast::checkSchedule(const StateReader& state) const {
  const std::uint32_t doublings = schedule_.error && round_ > 1 ? round_ - 1 : 0;
  state.require(passInRound_ <= schedule_.passes);
  state.require(schedule_.error ? round_ <= schedule_.maxDoublings : round_ == 0 || schedule_.deadline);
  state.require(receiversPerPass_ == std::ldexp(schedule_.receiversPerPass, static_cast<int>(doublings)));
}

/// What was read of the receivers that have been cast from.
void SideCast::checkReceivers(const StateReader& state) const {
  const std::uint32_t triangles = scene_.triangleCount();
  state.require(records_.size() == std::min<std::uint64_t>(receivers_, maxRecords));
  state.require(storedCount_ <= records_.size());
  texelRows_.check(state, projections_.texelRows > 0 ? records_.size() : 0, caster_.raysPerReceiver(),
                   projections_.texelCount);
  for (const SampleRecord& record : records_) {
    const SurfaceSample& sample = record.sample;
    state.require(sample.triangle < triangles && record.group < errorGroups);
    state.require(isShare(sample.b1) && isShare(sample.b2) && isShare(record.open));
    state.require(std::isfinite(sample.weight) && sample.weight >= 0.0f);
  }
  state.require(storedReceivers_.size() == (projections_.receivers ? storedCount_ : 0));
  for (const device::Receiver& receiver : storedReceivers_) {
    state.require(receiver.triangle < triangles);
    for (const float* vector : {receiver.position, receiver.normal, receiver.geometricNormal})
      state.requireFinite(std::span(vector, 3));
  }
  state.require(accessibility_.empty() || (occluders_ && accessibility_.size() == scene_.vertexCount()));
  for (const float accessibility : accessibility_) state.require(isShare(accessibility));
  for (const std::uint8_t seen : seen_) state.require(seen <= 3);
  for (const auto* marks : {&sampler_.active(), &sampler_.thinned()})
    for (const std::uint8_t mark : *marks) state.require(mark <= 1);
}

}  // namespace prelight
