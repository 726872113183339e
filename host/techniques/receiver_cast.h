#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "cast/scene_cast.h"
#include "cast/specular_column.h"
#include "cast/stored_transport.h"
#include "techniques/projector.h"
#include "techniques/slot_transfer.h"

namespace prelight {

/// The rays that techniques share, cast from receivers all over the surface, and what the least-squares fit
/// of the vertices makes of them.
class ReceiverCast {
 public:
  /// Casts the columns that the projectors ask for. What is given outlives it.
  ReceiverCast(const BakeContext& context, std::span<const std::unique_ptr<Projector>> projectors);

  /// Casts and fits. Throws Interrupted.
  void run(Progress& progress);

  const HemisphereColumn& hemisphere() const { return hemisphere_; }
  const SceneCast& scene() const { return cast_; }
  const SideSums& front() const { return cast_.front().sums(); }

  /// The caster, and the rows that bounces read (nullptr: no bounces run).
  Caster& caster() { return caster_; }
  StoredTransport* transport() { return transport_ ? &*transport_ : nullptr; }

  /// After run(): the front's solution, [slot][column] relative to the baseline.
  const std::vector<float>& fitted() const { return fitted_; }

  /// After run(): AO, [slot], in [0,1].
  const std::vector<double>& accessibility() const { return accessibility_; }

  /// After run(): light that surfaces receive, with all bounces. Made when it is asked for first.
  const SlotTransfer& transfer(Progress& progress);

  /// Bounces that run; 0 where the plan skips them.
  int bounces() const { return bounces_; }

  std::uint64_t receivers() const { return cast_.receivers(); }

  /// After all that casts through it: rays and receivers.
  void addTo(BakeReport& report) const;

  /// What run() has cast.
  void save(StateWriter& state) const;
  void load(StateReader& state);

 private:
  void cast(Progress& progress);
  std::vector<Column*> columnsOf(std::span<const std::unique_ptr<Projector>> projectors);

  const BakeContext& context_;
  int bounces_;
  bool keepsReflected_;                          ///< see SlotTransfer
  const LightColumn* carriedLight_;              ///< by bounces; nullptr: none
  std::chrono::steady_clock::time_point start_;  ///< of the bake, less what earlier runs of it took
  Schedule schedule_;
  HemisphereColumn hemisphere_;
  std::optional<SpecularColumn> specular_;
  std::optional<StoredTransport> transport_;
  Caster caster_;
  SceneCast cast_;
  std::vector<float> fitted_;
  std::vector<double> accessibility_;
  std::optional<SlotTransfer> transfer_;
};

}  // namespace prelight
