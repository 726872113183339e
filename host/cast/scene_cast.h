#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "cast/caster.h"
#include "cast/schedule.h"
#include "cast/side_cast.h"
#include "cast/stored_transport.h"
#include "prelight/progress.h"
#include "receivers/fit_mesh.h"

namespace prelight {

/// Places the receivers of a bake's fronts.
SurfaceSampler frontSampler(const CompiledScene& scene, const FitMesh& mesh, const Schedule& schedule);

/// Options of a cast from a scene.
struct SceneCastOptions {
  HemisphereColumn& guide;                     ///< one of the caster's columns
  StoredTransport* transport = nullptr;        ///< one of them, too; nullptr: no bounces follow
  const ShadowSets* sets = nullptr;            ///< of occluders; nullptr: all see everything
  std::vector<std::uint8_t> wantedBacks = {};  ///< [triangle], 1: cast from its back whatever rays meet; or
                                               ///< empty
  SumMemory memory = {};
};

/// Casts from the fronts of a scene and, where light bounces, from the backs that rays have met and from
/// those that these meet. Can be saved after an interruption and go on elsewhere.
class SceneCast {
 public:
  /// Everything given must outlive the cast. Without transport only wanted backs are cast from.
  SceneCast(const CompiledScene& scene, const FitMesh& mesh, Caster& caster, const Schedule& schedule,
            SceneCastOptions options);

  /// Goes on where a saved run was interrupted. `part` keeps what save() writes. Throws Interrupted.
  void run(Progress& progress, WorkPart& part);

  /// After run(), and without the trees that it took: the fits are ready to be solved.
  void finish(const Progress& progress);

  const SideCast& front() const { return front_; }

  /// nullptr when no back is seen.
  const SideCast* back() const { return back_.get(); }

  /// [triangle], 1 where the back is seen; empty without back().
  const std::vector<std::uint8_t>& backSeen() const { return backSeen_; }

  std::uint64_t receivers() const { return front_.receivers() + (back_ ? back_->receivers() : 0); }
  std::uint64_t rays() const { return front_.rays() + (back_ ? back_->rays() : 0); }

  /// States begin with what decides which receivers are cast from.
  void save(StateWriter& state) const;
  void load(StateReader& state);

 private:
  void loadPlacing(StateReader& state);
  void checkLoaded(const StateReader& state) const;
  bool isBeforePass() const;
  void makeBack();
  bool castsBacks() const;
  std::vector<std::uint8_t> knownBacks() const;
  bool markFreshBacks();

  const CompiledScene& scene_;
  const FitMesh& mesh_;
  Caster& caster_;
  const Schedule& schedule_;
  SceneCastOptions options_;
  std::uint32_t capacity_;  ///< receivers whose rows stay on the device
  SideCast front_;
  std::unique_ptr<SideCast> back_;
  std::vector<std::uint8_t> backSeen_;
  bool frontDone_ = false;
  std::uint32_t backRounds_ = 0;  ///< finished
};

}  // namespace prelight
