#include "cast/scene_cast.h"

#include <algorithm>
#include <utility>

namespace prelight {

namespace {

constexpr std::uint32_t maxBackRounds =
    4;  // backs seen from backs, and so on; what lies deeper reflects nothing

constexpr double leastReceivers = 4.0;  // of a component, in the first round

}  // namespace

SurfaceSampler frontSampler(const CompiledScene& scene, const FitMesh& mesh, const Schedule& schedule) {
  SurfaceSampler sampler(scene, schedule.seed, Side::Front, schedule.replicates);
  sampler.coverComponents(mesh, schedule.receiversPerPass * schedule.passes, leastReceivers);
  return sampler;
}

SceneCast::SceneCast(const CompiledScene& scene, const FitMesh& mesh, Caster& caster,
                     const Schedule& schedule, SceneCastOptions options)
    : scene_(scene),
      mesh_(mesh),
      caster_(caster),
      schedule_(schedule),
      options_(std::move(options)),
      capacity_(options_.transport != nullptr ? options_.transport->capacity() : 0),
      front_(scene, mesh, caster, options_.guide, schedule, options_.sets, options_.memory,
             frontSampler(scene, mesh, schedule)) {}

void SceneCast::run(Progress& progress, WorkPart& part) {
  if (!frontDone_) front_.run(progress, part, 0, capacity_);
  if (options_.memory.parks) front_.sums().park();
  frontDone_ = true;
  for (; castsBacks() && backRounds_ < maxBackRounds; ++backRounds_) {
    const bool goesOn = back_ && back_->running();
    if (!goesOn && !markFreshBacks()) return;
    back_->run(progress, part, front_.storedCount(), capacity_ - front_.storedCount());
  }
}

void SceneCast::finish(const Progress& progress) {
  if (options_.memory.parks && back_) back_->sums().park();
  if (back_) back_->finish(progress);
  front_.finish(progress);
}

void SceneCast::makeBack() {
  SumMemory memory = options_.memory;
  memory.recordBytes -= std::min(memory.recordBytes, front_.recordBytes());
  back_ = std::make_unique<SideCast>(scene_, mesh_, caster_, options_.guide, schedule_, options_.sets, memory,
                                     SurfaceSampler(front_.sampler(), schedule_.seed, Side::Back));
  backSeen_.assign(scene_.triangleCount(), 0);
}

bool SceneCast::castsBacks() const { return !options_.wantedBacks.empty() || capacity_ > 0; }

/// [triangle], 1 where the back is to be cast from, as far as is known.
std::vector<std::uint8_t> SceneCast::knownBacks() const {
  std::vector<std::uint8_t> known =
      capacity_ > 0 ? options_.transport->backMarks() : std::vector<std::uint8_t>(scene_.triangleCount(), 0);
  for (std::size_t t = 0; t < options_.wantedBacks.size(); ++t) known[t] |= options_.wantedBacks[t];
  return known;
}

// Makes the backs active that no round has cast from yet; false when there are none.
bool SceneCast::markFreshBacks() {
  std::vector<std::uint8_t> fresh = knownBacks();
  for (std::size_t t = 0; back_ && t < fresh.size(); ++t) fresh[t] = fresh[t] && !backSeen_[t];
  if (std::count(fresh.begin(), fresh.end(), 1) == 0) return false;
  if (!back_) makeBack();
  for (std::size_t t = 0; t < fresh.size(); ++t) backSeen_[t] |= fresh[t];
  back_->active() = std::move(fresh);
  back_->sums().limitTo(backSeen_);
  return true;
}

void SceneCast::save(StateWriter& state) const {
  front_.finishBlocks();
  if (back_) back_->finishBlocks();
  state.value(frontDone_);
  state.value(backRounds_);
  front_.savePlacing(state);
  if (options_.transport != nullptr) options_.transport->saveMarks(state);
  state.value(static_cast<std::uint8_t>(back_ != nullptr));
  if (back_) {
    state.values(backSeen_);
    back_->savePlacing(state);
  }
  front_.saveSums(state);
  caster_.save(state);
  if (back_) back_->saveSums(state);  // last: what grows keeps its place when there are some
}

void SceneCast::load(StateReader& state) {
  loadPlacing(state);
  if (state.partial() && isBeforePass()) return;
  front_.loadSums(state);
  caster_.load(state);
  if (back_) back_->loadSums(state);
  checkLoaded(state);
}

bool SceneCast::isBeforePass() const {
  if (!frontDone_) return front_.isBeforePass();
  return !back_ || !back_->running() || back_->isBeforePass();
}

void SceneCast::loadPlacing(StateReader& state) {
  std::uint8_t withBack = 0;
  state.value(frontDone_);
  state.value(backRounds_);
  front_.loadPlacing(state);
  if (options_.transport != nullptr) options_.transport->loadMarks(state);
  state.value(withBack);
  if (withBack == 0) return;
  makeBack();
  state.sameSize(backSeen_);
  for (const std::uint8_t seen : backSeen_) state.require(seen <= 1);
  back_->sums().limitTo(backSeen_);
  back_->loadPlacing(state);
}

/// Checks what was read as a whole.
void SceneCast::checkLoaded(const StateReader& state) const {
  std::uint32_t rows = front_.storedCount();
  state.require(front_.storedFirst() == 0 && rows <= capacity_);
  if (back_) {
    state.require(back_->storedFirst() == rows && back_->storedCount() <= capacity_ - rows);
    rows += back_->storedCount();
  }
  // Bounces have transfer of backs where a back is marked, or has been cast from.
  const StoredTransport::Loaded stored =
      options_.transport != nullptr ? options_.transport->loaded() : StoredTransport::Loaded{};
  state.require(stored.rows == rows && (!stored.fromBacks || back_ || stored.marked));
  // Rounds begin with a side, and stop at one that has nothing to cast from.
  state.require(backRounds_ <= maxBackRounds && (back_ || backRounds_ == 0) &&
                frontDone_ != front_.running());
}

}  // namespace prelight
