#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "base/background_work.h"
#include "base/kept_work.h"
#include "cast/caster.h"
#include "prelight/progress.h"
#include "projectors/projections.h"
#include "projectors/schedule.h"
#include "projectors/side_sums.h"
#include "receivers/surface_sampler.h"

namespace prelight {

/// Casts from one side of the surface until its schedule is fulfilled, and fits the vertices.
class SideCast {
 public:
  /// `sampler` says which side, whose baseline is given.
  SideCast(const CompiledScene& scene, const FitMesh& mesh, Caster& caster, const Schedule& schedule,
           const Projections& projections, SurfaceSampler sampler, Baseline baseline);

  const SurfaceSampler& sampler() const { return sampler_; }

  /// Triangles that receivers are placed on; all unless changed before run().
  std::vector<std::uint8_t>& active() { return sampler_.active(); }

  /// Fitted values are wanted at the corners of these triangles alone, [triangle]; of all unless it is
  /// called.
  void limitTo(std::span<const std::uint8_t> triangles) { sums_.limitTo(triangles); }

  /// `storedFirst` and `storedCapacity` say which rows of the caster's senders this side may fill. After
  /// load(), goes on where the saved run was interrupted. `part` keeps what save() writes.
  void run(Progress& progress, WorkPart& part, std::uint32_t storedFirst, std::uint32_t storedCapacity);

  /// Ends the last run of all sides: the fit is ready to be solved.
  void finish(const Progress& progress) {
    sampler_.endPasses();
    sums_.soften();
    sums_.stiffen(progress);
  }

  /// Between runs: what was summed up lies in a file until the next.
  void park() { sums_.park(); }

  /// True between the start of a run and its end, so also after one that was interrupted.
  bool running() const { return running_; }

  /// Waits until all blocks that were handed over have been cast and added up.
  void finishBlocks() const;

  void save(StateWriter& state) const;
  void load(StateReader& state);

  /// The fitted values, and how far off their AO is.
  FittedSide solve(const Progress& progress) const { return sums_.solve(progress); }

  /// Fitted unit mean open direction minus the slot's normal, [slot][3]. Only where the schedule asks for it.
  std::vector<float> solveBentNormal(const Progress& progress) const {
    SolveLimits limits = noisyValues();
    limits.progress = &progress;
    return sums_.bentFit().solve(defaultSmoothing, limits);
  }

  /// Fitted direct light of groups of lights, [slot][3][group]. Only where the projections ask for it.
  std::vector<float> solveLights(const Progress& progress) const {
    return sums_.lightFit().solve(defaultSmoothing, {.progress = &progress});
  }

  /// Fitted transfer of what comes by mirrors and glass, [slot][3][i]. Only where the projections ask for it.
  std::vector<float> solveSpecular(const Progress& progress) const {
    return sums_.specularFit().solve(defaultSmoothing, {.progress = &progress});
  }

  /// Fitted shells of distance, [slot][shell][i]. Only where the projections ask for them.
  std::vector<float> solveShells(const Progress& progress) const {
    return sums_.shellFit().solve(defaultSmoothing, {.progress = &progress});
  }

  /// Fitted values of sectors of azimuth (cast/sector_caster.h), [slot][3][sector], of which what escapes is
  /// less 1: by the equations of AO, which is the mean of that. Only where the projections ask for it.
  std::vector<float> solveSectors(const Progress& progress) const {
    return sums_.sectorFit().solve(fit().equations(defaultSmoothing), {.progress = &progress});
  }

  /// What is seen of occluders. Only where the projections ask for it.
  const OccluderMeans& occluders() const { return sums_.occluders(); }

  /// The fit itself, for those who project the rays by themselves.
  const VertexFit& fit() const { return sums_.fit(); }

  /// Rays texel by texel, parallel to records().
  const TexelRows& texelRows() const { return sums_.texelRows(); }

  /// Receivers of the stored rows, parallel to records(). Only where the projections ask for them.
  const std::vector<device::Receiver>& storedReceivers() const { return storedReceivers_; }

  /// A fit of the stored rows' places, without values.
  VertexFit fitOfStoredRows() const { return sums_.fitOf(storedCount_); }

  const Baseline& baseline() const { return sums_.baseline(); }
  const SampleRecords& records() const { return sums_.records(); }
  std::uint32_t storedFirst() const { return storedFirst_; }
  std::uint32_t storedCount() const { return storedCount_; }

  /// That have been cast from. Waits for the blocks on their way.
  std::uint64_t receivers() const {
    finishBlocks();
    return receivers_;
  }
  std::size_t slotCount() const { return mesh_.slotCount(); }
  std::uint64_t rays() const { return receivers() * schedule_.raysPerReceiver; }  ///< of the hemispheres

 private:
  void checkSchedule(const StateReader& state) const;
  void checkReceivers(const StateReader& state) const;
  void start();
  bool timeIsUp() const;
  bool endRound(const Progress& progress);
  void castPass(Progress& progress, WorkPart& part);
  void estimateAccessibility(const Progress& progress);
  void flush();
  void sortPendingBySet();
  void handOver(std::size_t first, std::size_t count, std::uint32_t set);
  void castBlock(CastBlock& block, std::uint32_t set);
  void finishStarted() const;
  std::uint32_t setOf(const SurfaceSample& sample) const;
  void thinPlainTriangles();
  std::size_t dropAccurateTriangles(const Progress& progress);

  const CompiledScene& scene_;
  const FitMesh& mesh_;
  Caster& caster_;
  const Schedule& schedule_;
  Projections projections_;
  SurfaceSampler sampler_;
  SideSums sums_;
  std::vector<float> accessibility_;  ///< [vertex], of occluders; empty: not known yet
  std::vector<device::Receiver> storedReceivers_;
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
  bool accessibilityDue_ = false;       ///< before the next pass
  SurfaceSampler::Position passStart_;  ///< where the sequences stood when the pass at hand began
  std::uint64_t doneInPass_ = 0;        ///< receivers of the pass at hand
  std::vector<CastBlock> blocks_;       ///< used in turns
  std::size_t nextBlock_ = 0;
  std::size_t startedPlace_ = 0;  ///< the caster's, of the block that was started last
  mutable std::function<void()>
      started_;  ///< waits for the block that the device has been given and hands it to adding_; or empty
  mutable BackgroundWork adding_;   ///< of blocks to the sums; after what it uses, so that it ends before
  mutable BackgroundWork casting_;  ///< of blocks that it hands to adding_
};

}  // namespace prelight
