#include "bake/side_cast.h"

#include <algorithm>

namespace prelight {

namespace {

constexpr std::uint32_t pilotPasses = 2;       // after which entirely open neighbourhoods stop
constexpr double bentNormalHalfWeight = 0.05;  // mean open vector of 64 rays is known to about 0.02
constexpr std::size_t maxRecords = std::size_t{1} << 24;  // 400 MB; an error target gives up there

}  // namespace

SideCast::SideCast(const CompiledScene& scene, const FitMesh& mesh, Caster& caster, const Schedule& schedule,
                   Side side)
    : scene_(scene),
      mesh_(mesh),
      caster_(caster),
      schedule_(schedule),
      sampler_(scene, schedule.seed, side, schedule.error ? errorGroups : 1),
      baseline_(scene, mesh, schedule.shOrder, side == Side::Front ? 1.0 : -1.0),
      fit_(emptyFit(baseline_.columns())),
      blocked_(mesh.slotCount(), 0),
      residual_(baseline_.columns()) {
  if (schedule.bentNormal && side == Side::Front) bentFit_.emplace(emptyFit(3));
}

void SideCast::run(Progress& progress, std::uint32_t storedFirst, std::uint32_t storedCapacity) {
  storedFirst_ = storedFirst;
  storedCapacity_ = storedCapacity;
  double receivers = schedule_.receiversPerPass;
  for (std::uint32_t round = 0;; ++round) {
    for (std::uint32_t i = 0; i < schedule_.passes; ++i) {
      // The first round is owed: without it, there would be nothing to fit.
      if (round > 0 && schedule_.deadline && std::chrono::steady_clock::now() >= *schedule_.deadline) return;
      castPass(receivers, progress);
      if (pass_ == pilotPasses) dropOpenTriangles();
    }
    if (schedule_.error) {
      if (dropAccurateTriangles() == 0 || round == schedule_.maxDoublings || records_.size() == maxRecords)
        return;
      if (round > 0) receivers *= 2.0;  // every round doubles what its triangles have had
    } else if (!schedule_.deadline) {
      return;
    }
  }
}

void SideCast::castPass(double receivers, Progress& progress) {
  const auto flushAndReport = [&] {
    flush();
    progress.check();
  };
  sampler_.pass(receivers, schedule_.raysPerReceiver,
                [&](const SurfaceSample& sample, const device::Receiver& receiver) {
                  pendingSamples_.push_back(sample);
                  pendingReceivers_.push_back(receiver);
                  if (pendingReceivers_.size() == caster_.blockSize()) flushAndReport();
                });
  flushAndReport();
  ++pass_;
  if (!schedule_.deadline && !schedule_.error) progress.report("cast", double(pass_) / schedule_.passes);
}

void SideCast::flush() {
  const auto count = static_cast<std::uint32_t>(pendingReceivers_.size());
  if (count == 0) return;
  const std::uint32_t row = storedFirst_ + storedCount_;
  // Bounces read the records of stored rows, so a row is kept only where its record is.
  const bool stores = storedCount_ + count <= storedCapacity_ && storedCount_ == receivers_ &&
                      receivers_ + count <= maxRecords;
  caster_.cast(pendingReceivers_, values_, stores ? &row : nullptr);
  if (stores) storedCount_ += count;
  for (std::size_t i = 0; i < count; ++i) addReceiver(i);
  receivers_ += count;
  pendingSamples_.clear();
  pendingReceivers_.clear();
}

// The kernel's values are those of the blocked part; what an open hemisphere has is added in closed form,
// then the interpolated baseline is taken off, so that the fit sees only what occlusion changes.
void SideCast::addReceiver(std::size_t i) {
  const SurfaceSample& sample = pendingSamples_[i];
  const device::Receiver& receiver = pendingReceivers_[i];
  const float* values = &values_[i * caster_.valueCount()];
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
  if (open < 1.0)
    for (const std::uint32_t slot : slots) blocked_[slot] = 1;
  if (records_.size() < maxRecords) records_.push_back({sample, values[0], pass_ % errorGroups});
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

// Where every ray of every receiver around escaped, the closed form is the answer: no further rays.
void SideCast::dropOpenTriangles() {
  auto& active = sampler_.active();
  for (std::size_t t = 0; t < active.size(); ++t) {
    const auto& slots = mesh_.triangles[t];
    if (!blocked_[slots[0]] && !blocked_[slots[1]] && !blocked_[slots[2]]) active[t] = 0;
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
VertexFit SideCast::emptyFit(std::size_t columns) const {
  return schedule_.error ? VertexFit(mesh_, columns, sampler_.areas()) : VertexFit(mesh_, columns);
}

ErrorEstimate SideCast::estimateError() const {
  return estimateAoError(mesh_, fit_, fit_.solveColumns(defaultSmoothing, 0, 1), records_);
}

}  // namespace prelight
