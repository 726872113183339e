#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "base/kept_work.h"
#include "base/threads.h"
#include "base/work_share.h"
#include "cast/caster.h"
#include "cast/schedule.h"
#include "cast/side_sums.h"
#include "prelight/progress.h"
#include "receivers/surface_sampler.h"

namespace prelight {

/// Casts from one side of the surface until its schedule is fulfilled, and sums up what its receivers see.
class SideCast {
 public:
  /// `sampler` says which side. `guide` is one of the caster's columns. Everything outlives it.
  SideCast(const CompiledScene& scene, const FitMesh& mesh, Caster& caster, HemisphereColumn& guide,
           const Schedule& schedule, const ShadowSets* sets, const SumMemory& memory, SurfaceSampler sampler);

  const SurfaceSampler& sampler() const { return sampler_; }

  /// Triangles that receivers are placed on; all unless changed before run().
  std::vector<std::uint8_t>& active() { return sampler_.active(); }

  /// Sums of all columns.
  SideSums& sums() { return sums_; }
  const SideSums& sums() const { return sums_; }

  /// `storedFirst` and `storedCapacity` say which rows this side may fill in columns that keep them on the
  /// device. After load(), goes on where the saved run was interrupted. `part` keeps what save() writes.
  void run(Progress& progress, WorkPart& part, std::uint32_t storedFirst, std::uint32_t storedCapacity);

  /// Ends the last run of all sides: the fit is ready to be solved.
  void finish(const Progress& progress) {
    sampler_.endPasses();
    sums_.soften();
    sums_.stiffen(progress);
  }

  /// True between the start of a run and its end, so also after one that was interrupted.
  bool running() const { return running_; }

  /// Waits until all blocks that were handed over have been cast and added up.
  void finishBlocks() const;

  /// The placing is the part of the state that decides where further receivers lie.
  void savePlacing(StateWriter& state) const;
  void loadPlacing(StateReader& state);

  /// The sums are the other part: they hold what the receivers have seen.
  void saveSums(StateWriter& state) const { sums_.save(state); }
  void loadSums(StateReader& state);

  /// True where the next step is a pass: the sums are not needed to place its receivers.
  bool isBeforePass() const { return running_ && !accessibilityDue_ && passInRound_ < schedule_.passes; }

  std::uint32_t storedFirst() const { return storedFirst_; }
  std::uint32_t storedCount() const { return storedCount_; }

  /// That have been cast from. Waits for the blocks on their way.
  std::uint64_t receivers() const {
    finishBlocks();
    return receivers_;
  }

  /// Bytes in memory of the records of the receivers cast from so far.
  std::uint64_t recordBytes() const {
    return sums_.records().bytesInMemory(std::min<std::uint64_t>(receivers_, SampleRecords::most));
  }
  std::size_t slotCount() const { return mesh_.slotCount(); }
  std::uint64_t rays() const { return receivers() * schedule_.raysPerReceiver; }  ///< of the hemispheres

 private:
  /// Passes [first, end) of a round.
  struct PassRange {
    std::uint32_t first, end;
  };

  /// Writes or reads the counts of the schedule, in one order for both.
  template <typename Self, typename State>
  static void exchangeCounts(Self& cast, State& state);
  void checkSchedule(const StateReader& state) const;
  void checkReceivers(const StateReader& state) const;
  void start();
  bool timeIsUp() const;
  bool endRound(const Progress& progress);
  void castPass(Progress& progress, WorkPart& part);
  PassRange passesOfStage() const;
  std::string stage() const;
  void endPass();
  void estimateAccessibility(const Progress& progress);
  void tellAccessibility();
  void flush();
  void sortPendingBySet();
  void handOver(std::size_t first, std::size_t count, std::uint32_t set);
  CastTask nextTask(std::uint32_t count, std::uint32_t set) const;
  void takeBlock(SeenBlock& block, const WorkPiece& piece);
  void startBlock(SeenBlock& block, const WorkPiece& piece);
  void finishStarted() const;
  std::uint32_t setOf(const SurfaceSample& sample) const;
  void thinPlainTriangles();
  std::size_t dropAccurateTriangles(const Progress& progress);

  const CompiledScene& scene_;
  const FitMesh& mesh_;
  Caster& caster_;
  const Schedule& schedule_;
  const ShadowSets* sets_;  ///< of occluders; nullptr: all see everything
  SurfaceSampler sampler_;
  SideSums sums_;
  bool tellsAccessibility_;           ///< to columns that want to know it
  std::vector<float> accessibility_;  ///< [vertex], what they have been told; empty: nothing yet
  std::vector<SurfaceSample> pendingSamples_;
  std::vector<device::Receiver> pendingReceivers_;
  std::uint32_t storedFirst_ = 0;
  std::uint32_t storedCapacity_ = 0;
  std::uint32_t storedCount_ = 0;
  std::uint64_t receivers_ = 0;
  std::uint32_t pass_ = 0;
  bool running_ = false;
  std::uint32_t round_ = 0;
  std::uint32_t passInRound_ = 0;
  double receiversPerPass_ = 0.0;
  bool inPass_ = false;
  std::optional<SharedLoop> loop_;  ///< over the blocks of the passes up to the next that is looked back on
  bool accessibilityDue_ = false;   ///< before the next pass
  SurfaceSampler::Position passStart_;  ///< where the sequences stood when the pass at hand began
  std::uint64_t doneInPass_ = 0;        ///< receivers of the pass at hand
  std::vector<SeenBlock> blocks_;       ///< used in turns
  std::size_t nextBlock_ = 0;
  std::size_t startedPlace_ = 0;  ///< the caster's, of the block that was started last
  mutable std::function<void()>
      started_;  ///< waits for the block that the device has been given and hands it to adding_; or empty
  mutable BackgroundWork adding_;   ///< of blocks to the sums; after what it uses, so that it ends before
  mutable BackgroundWork casting_;  ///< of blocks that it hands to adding_
};

}  // namespace prelight
