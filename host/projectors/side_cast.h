#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "cast/caster.h"
#include "fit/baseline.h"
#include "fit/error_estimate.h"
#include "fit/vertex_fit.h"
#include "prelight/progress.h"
#include "projectors/occluder_means.h"
#include "projectors/projections.h"
#include "projectors/schedule.h"
#include "projectors/texel_rows.h"
#include "receivers/surface_sampler.h"

namespace prelight {

/// Casts from one side of the surface until its schedule is fulfilled, and fits the vertices.
class SideCast {
 public:
  SideCast(const CompiledScene& scene, const FitMesh& mesh, Caster& caster, const Schedule& schedule,
           const Projections& projections, Side side);

  /// Triangles that receivers are placed on; all unless changed before run().
  std::vector<std::uint8_t>& active() { return sampler_.active(); }

  /// `storedFirst` and `storedCapacity` say which rows of the caster's senders this side may fill. After
  /// load(), goes on where the saved run was interrupted.
  void run(Progress& progress, std::uint32_t storedFirst, std::uint32_t storedCapacity);

  /// True between the start of a run and its end, so also after one that was interrupted.
  bool running() const { return running_; }

  void save(StateWriter& state) const;
  void load(StateReader& state);

  /// Fitted values relative to the baseline, [slot][column].
  std::vector<double> solve() const { return fit_.solve(defaultSmoothing); }

  /// Fitted unit mean open direction minus the slot's normal, [slot][3]. Only where the schedule asks for it.
  std::vector<double> solveBentNormal() const { return bentFit_.value().solve(defaultSmoothing); }

  /// Fitted direct light of groups of lights, [slot][3][group]. Only where the projections ask for it.
  std::vector<double> solveLights() const { return lightFit_.value().solve(defaultSmoothing); }

  /// What is seen of occluders. Only where the projections ask for it.
  const OccluderMeans& occluders() const { return occluders_.value(); }

  /// The fit itself, for those who project the rays by themselves.
  const VertexFit& fit() const { return fit_; }

  /// Rays texel by texel, parallel to records().
  const TexelRows& texelRows() const { return texelRows_; }

  /// Receivers of the stored rows, parallel to records(). Only where the projections ask for them.
  const std::vector<device::Receiver>& storedReceivers() const { return storedReceivers_; }

  ErrorEstimate estimateError() const;

  /// A fit without samples that weighs them as this side's own does.
  VertexFit emptyFit(std::size_t columns) const;

  const Baseline& baseline() const { return baseline_; }
  const std::vector<SampleRecord>& records() const { return records_; }
  std::uint32_t storedFirst() const { return storedFirst_; }
  std::uint32_t storedCount() const { return storedCount_; }
  std::uint64_t receivers() const { return receivers_; }
  std::uint64_t rays() const { return receivers_ * schedule_.raysPerReceiver; }  ///< of the hemispheres

 private:
  VertexFit plainFit(std::size_t columns) const;
  void checkSchedule(const StateReader& state) const;
  void checkReceivers(const StateReader& state) const;
  void start();
  bool endRound();
  void castPass(Progress& progress);
  void stiffen();
  void estimateAccessibility();
  void flush();
  void sortPendingBySet();
  void castBlock(std::size_t first, std::uint32_t count, std::uint32_t set);
  std::uint32_t setOf(const SurfaceSample& sample) const;
  void addReceiver(std::size_t pending, std::size_t i);
  void addBentNormal(const SurfaceSample& sample, const glm::dvec3& meanOpen);
  void addLights(const SurfaceSample& sample, std::size_t i);
  void markSlots(const SurfaceSample& sample, double open);
  void thinPlainTriangles();
  std::size_t dropAccurateTriangles();

  const CompiledScene& scene_;
  const FitMesh& mesh_;
  Caster& caster_;
  const Schedule& schedule_;
  Projections projections_;
  SurfaceSampler sampler_;
  Baseline baseline_;
  VertexFit fit_;
  std::optional<VertexFit> bentFit_;
  std::optional<VertexFit> lightFit_;
  std::optional<OccluderMeans> occluders_;
  std::vector<float> accessibility_;  ///< [vertex], of occluders; empty: not known yet
  std::vector<SampleRecord> records_;
  TexelRows texelRows_;
  std::vector<device::Receiver> storedReceivers_;
  std::vector<std::uint8_t> seen_;       ///< [slot], what rays around it met: bit 0 the open, bit 1 surface
  std::vector<std::uint32_t> slotRays_;  ///< [slot], rays of the triangles around it
  std::vector<SurfaceSample> pendingSamples_;
  std::vector<device::Receiver> pendingReceivers_;
  CastValues values_;
  std::vector<double> residual_;
  std::vector<double> lightRow_;
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
  SurfaceSampler::Position passStart_;  ///< where the sequences stood when the pass at hand began
  std::uint64_t doneInPass_ = 0;        ///< receivers of the pass at hand
};

}  // namespace prelight
