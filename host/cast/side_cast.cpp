#include "cast/side_cast.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <numeric>
#include <utility>

namespace prelight {

namespace {

constexpr std::size_t waitingBlocks = 1;  // before they are cast, and before they are added

bool anyWantsAccessibility(const std::vector<Column*>& columns, Side side) {
  return std::any_of(columns.begin(), columns.end(), [&](const Column* column) {
    return column->castFrom(side) && column->needs().accessibility;
  });
}

}  // namespace

SideCast::SideCast(const CompiledScene& scene, const FitMesh& mesh, Caster& caster, HemisphereColumn& guide,
                   const Schedule& schedule, const ShadowSets* sets, const SumMemory& memory,
                   SurfaceSampler sampler)
    : scene_(scene),
      mesh_(mesh),
      caster_(caster),
      schedule_(schedule),
      sets_(sets),
      sampler_(std::move(sampler)),
      sums_({scene, mesh, sampler_.side(), schedule.raysPerReceiver, &sampler_.areas()}, schedule, guide,
            caster.columns(), memory),
      tellsAccessibility_(anyWantsAccessibility(caster.columns(), sampler_.side())),
      blocks_(2 * BackgroundWork::placesFor(
                      waitingBlocks)),  // all that wait or are worked on, and the one that is started
      adding_(waitingBlocks),
      casting_(waitingBlocks) {}

void SideCast::start() {
  running_ = true;
  round_ = passInRound_ = 0;
  sums_.soften();
  receiversPerPass_ = schedule_.receiversPerPass;
}

// Each turn of the loop leaves a state to go on from.
void SideCast::run(Progress& progress, WorkPart& part, std::uint32_t storedFirst,
                   std::uint32_t storedCapacity) {
  storedFirst_ = storedFirst;
  storedCapacity_ = storedCapacity;
  if (!running_) start();
  sums_.unpark();
  while (running_) {
    if (accessibilityDue_)
      estimateAccessibility(progress);
    else if (passInRound_ < schedule_.passes && !timeIsUp())
      castPass(progress, part);
    else
      running_ = passInRound_ == schedule_.passes && !endRound(progress);
    part.advance();
  }
}

// The first round is owed: without it, there would be nothing to fit.
bool SideCast::timeIsUp() const {
  return round_ > 0 && schedule_.deadline && std::chrono::steady_clock::now() >= *schedule_.deadline;
}

// True when the schedule is fulfilled.
bool SideCast::endRound(const Progress& progress) {
  if (schedule_.error) {
    if (dropAccurateTriangles(progress) == 0 || round_ == schedule_.maxDoublings ||
        sums_.records().size() == SampleRecords::most)
      return true;
    if (round_ > 0) receiversPerPass_ *= 2.0;  // every round doubles what its triangles have had
  } else if (!schedule_.deadline) {
    return true;
  }
  ++round_;
  passInRound_ = 0;
  return false;
}

// Passes look back on what earlier ones have seen, to place their receivers by it. Processes that divide a
// cast meet wherever it does, so it does so seldom: on fronts after a quarter of a round, where 1024 rays a
// vertex are the first that have enough of them around most slots; where columns follow accessibility,
// whenever the passes have doubled; on backs, which are few, after a round.
SideCast::PassRange SideCast::passesOfStage() const {
  if (sampler_.side() == Side::Back) return {0, schedule_.passes};
  if (tellsAccessibility_) {
    const std::uint32_t first = std::bit_floor(passInRound_);
    return {first, std::min(std::max(2 * first, 1u), schedule_.passes)};
  }
  const std::uint32_t look = schedule_.passes / 4;
  return passInRound_ < look ? PassRange{0, look} : PassRange{look, schedule_.passes};
}

std::string SideCast::stage() const {
  const PassRange inRound = passesOfStage();
  const std::uint32_t before = pass_ - passInRound_, first = before + inRound.first + 1,
                      last = before + inRound.end;
  const std::string passes =
      last > first ? fmt::format("passes {} to {}", first, last) : fmt::format("pass {}", first);
  return fmt::format("cast from {}, {}", sampler_.side() == Side::Front ? "fronts" : "backs", passes);
}

// A pass that was interrupted is walked again, without what has been cast of it.
void SideCast::castPass(Progress& progress, WorkPart& part) {
  if (!loop_) loop_.emplace(part, stage());
  if (!inPass_) {
    passStart_ = sampler_.position();
    doneInPass_ = 0;
    inPass_ = true;
  }
  sampler_.restore(passStart_);
  const auto flushAndReport = [&] {
    flush();
    part.advance();
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
  finishBlocks();
  inPass_ = false;
  passStart_ = {};
  endPass();
  if (!schedule_.deadline && !schedule_.error) progress.report("cast", double(pass_) / schedule_.passes);
}

void SideCast::endPass() {
  const bool ends = passInRound_ + 1 == passesOfStage().end;
  ++pass_;
  ++passInRound_;
  if (!ends) return;
  loop_->end();
  loop_.reset();
  accessibilityDue_ = tellsAccessibility_ && std::has_single_bit(pass_);
  thinPlainTriangles();
}

// The first pass is for accessibility alone, and the passes after it know the more of it the later they are.
void SideCast::estimateAccessibility(const Progress& progress) {
  const std::vector<float> blocked = sums_.fit().solveColumn(defaultSmoothing, 0, {.progress = &progress});
  accessibility_.resize(scene_.vertexCount());
  for (std::uint32_t v = 0; v < scene_.vertexCount(); ++v)
    accessibility_[v] =
        static_cast<float>(std::clamp(1.0 + double(blocked[mesh_.slotOfVertex[v]]), 0.0, 1.0));
  tellAccessibility();
  accessibilityDue_ = false;
}

void SideCast::tellAccessibility() {
  for (Column* column : caster_.columns())
    if (column->needs().accessibility) column->setAccessibility(scene_, accessibility_);
}

std::uint32_t SideCast::setOf(const SurfaceSample& sample) const {
  return sets_ != nullptr ? sets_->setOf(sample.triangle) : 0;
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

void SideCast::finishBlocks() const {
  casting_.add([this] { finishStarted(); });
  casting_.finish();
  adding_.finish();
}

// A block is whole again at the end, whichever sets its receivers are of: an interrupted pass goes on there.
void SideCast::flush() {
  if (sets_ != nullptr && !sets_->empty()) sortPendingBySet();
  for (std::size_t first = 0; first < pendingReceivers_.size();) {
    const std::uint32_t set = setOf(pendingSamples_[first]);
    std::size_t end = first + 1;
    while (end < pendingSamples_.size() && setOf(pendingSamples_[end]) == set) ++end;
    handOver(first, end - first, set);
    first = end;
  }
  pendingSamples_.clear();
  pendingReceivers_.clear();
}

// While the device casts a block, the host places the receivers of the next and adds up what the one before
// saw.
void SideCast::handOver(std::size_t first, std::size_t count, std::uint32_t set) {
  const auto some = static_cast<std::uint32_t>(count);
  const WorkPiece piece{receivers_, count};
  const CastTask task = nextTask(some, set);
  if (task.firstRow) storedCount_ += some;
  receivers_ += count;
  doneInPass_ += count;
  const PieceSource source = loop_->sourceOf(piece);
  if (source == PieceSource::Elsewhere) return;
  SeenBlock& block = blocks_[nextBlock_++ % blocks_.size()];
  const auto samples = std::span(pendingSamples_).subspan(first, count);
  const auto receivers = std::span(pendingReceivers_).subspan(first, count);
  block.samples.assign(samples.begin(), samples.end());
  block.receivers.assign(receivers.begin(), receivers.end());
  block.group = pass_ % errorGroups;
  block.task = task;
  casting_.add([this, &block, piece, source] {
    source == PieceSource::Given ? takeBlock(block, piece) : startBlock(block, piece);
  });
}

// Bounces read the records of stored rows, so a row is kept only where its record is.
CastTask SideCast::nextTask(std::uint32_t count, std::uint32_t set) const {
  const bool stores = storedCount_ + count <= storedCapacity_ && storedCount_ == receivers_ &&
                      receivers_ + count <= SampleRecords::most;
  CastTask task{sampler_.side(), set, std::nullopt};
  if (stores) task.firstRow = storedFirst_ + storedCount_;
  return task;
}

void SideCast::takeBlock(SeenBlock& block, const WorkPiece& piece) {
  finishStarted();
  loop_->take(piece, [&](StateReader& state) {
    caster_.loadBlock(state, block.rows, block.task, static_cast<std::uint32_t>(piece.count));
  });
  adding_.add([this, &block] { sums_.add(block); });
}

void SideCast::startBlock(SeenBlock& block, const WorkPiece& piece) {
  // A block that is alone takes the first place: the memory of others is not touched in vain.
  const std::size_t place = started_ ? (startedPlace_ + 1) % caster_.places() : 0;
  caster_.start(place, block.receivers, block.task);
  finishStarted();
  startedPlace_ = place;
  started_ = [this, &block, piece, place] {
    caster_.finish(place, block.rows);
    const auto count = static_cast<std::uint32_t>(piece.count);
    const auto save = [&](StateWriter& state) { caster_.saveBlock(state, block.rows, block.task, count); };
    if (loop_->give(piece, save)) adding_.add([this, &block] { sums_.add(block); });
  };
  if (caster_.places() == 1) finishStarted();
}

// One block is always under way while another is waited for: its kernels fill the cores where those of the
// other run out of work.
void SideCast::finishStarted() const {
  if (const std::function<void()> finish = std::exchange(started_, nullptr)) finish();
}

// Where every ray around escaped, the closed form is most likely the answer, and where every one was blocked,
// 0. A few more rays are cast there all the same, each for many: were there none, what the first rays missed
// would be missed on average, too.
void SideCast::thinPlainTriangles() {
  parallelRanges(mesh_.triangles.size(), 16384, [&](std::size_t begin, std::size_t end) {
    for (std::size_t t = begin; t < end; ++t) sampler_.thinned()[t] = sums_.isPlain(t) ? 1 : 0;
  });
}

// A slot's value hangs through the fit on the samples around its neighbours, so those are refined with it.
std::size_t SideCast::dropAccurateTriangles(const Progress& progress) {
  const ErrorEstimate estimate = sums_.estimateError(progress);
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

template <typename Self, typename State>
void SideCast::exchangeCounts(Self& cast, State& state) {
  state.value(cast.storedFirst_);
  state.value(cast.storedCount_);
  state.value(cast.receivers_);
  state.value(cast.pass_);
  state.value(cast.running_);
  state.value(cast.round_);
  state.value(cast.passInRound_);
  state.value(cast.receiversPerPass_);
  state.value(cast.inPass_);
  state.value(cast.accessibilityDue_);
  state.value(cast.doneInPass_);
}

void SideCast::savePlacing(StateWriter& state) const {
  state.values(accessibility_);
  state.values(sampler_.active());
  state.values(sampler_.thinned());
  const SurfaceSampler::Position& position = inPass_ ? passStart_ : sampler_.position();
  state.values(position.taken);
  state.value(position.passes);
  exchangeCounts(*this, state);
}

void SideCast::loadPlacing(StateReader& state) {
  state.values(accessibility_);
  state.sameSize(sampler_.active());
  state.sameSize(sampler_.thinned());
  passStart_ = sampler_.position();
  state.sameSize(passStart_.taken);
  state.value(passStart_.passes);
  sampler_.restore(passStart_);
  exchangeCounts(*this, state);
  checkSchedule(state);
  checkReceivers(state);
  if (!accessibility_.empty()) tellAccessibility();
}

void SideCast::loadSums(StateReader& state) {
  sums_.load(state, storedCount_);
  state.require(sums_.records().size() == std::min<std::uint64_t>(receivers_, SampleRecords::most));
}

/// Checks what was read of the schedule.
void SideCast::checkSchedule(const StateReader& state) const {
  const std::uint32_t doublings = schedule_.error && round_ > 1 ? round_ - 1 : 0;
  state.require(passInRound_ <= schedule_.passes);
  state.require(schedule_.error ? round_ <= schedule_.maxDoublings : round_ == 0 || schedule_.deadline);
  state.require(receiversPerPass_ == std::ldexp(schedule_.receiversPerPass, static_cast<int>(doublings)));
}

/// Checks what was read of the placing of receivers.
void SideCast::checkReceivers(const StateReader& state) const {
  state.require(accessibility_.empty() ||
                (tellsAccessibility_ && accessibility_.size() == scene_.vertexCount()));
  for (const float accessibility : accessibility_) state.require(isShare(accessibility));
  for (const auto* marks : {&sampler_.active(), &sampler_.thinned()})
    for (const std::uint8_t mark : *marks) state.require(mark <= 1);
}

}  // namespace prelight
