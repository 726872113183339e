#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "base/state_file.h"
#include "prelight/bake.h"
#include "prelight/compiled_scene.h"
#include "prelight/device.h"
#include "prelight/plan.h"
#include "prelight/progress.h"
#include "scene/gltf/charts.h"

namespace prelight {

/// Where a bake leaves what it has done, when it is interrupted and now and then before, and finds it again.
class BakeCheckpoint {
 public:
  virtual ~BakeCheckpoint() = default;

  /// The state of an earlier run of the same bake (see bakeKey), if one is to be continued.
  virtual std::optional<StateReader> load() = 0;

  /// Keeps the state that `write` writes, in place of an earlier one. Not called before the first rays are
  /// cast. A state that cannot be kept is no reason for a bake to fail.
  virtual void save(const std::function<void(StateWriter&)>& write) = 0;

  /// Seconds between two states of a run that nobody interrupts (see SavingProgress).
  virtual double interval() const { return 30.0; }
};

/// What a bake's state depends on: scene, options, seed and device.
StateKey bakeKey(const CompiledScene& scene, const BakeRequest& request, const DeviceInfo& device);

/// Bakes what the plan says. Values are finite for every vertex, also for those that no triangle uses.
/// Same scene, request and seed give the same bytes on the same device, whatever the thread count.
/// However often it was interrupted and continued in between, too, unless it bakes against time.
/// Transfer of texels is made of `charts`, and a light map of `source`, whose scene it is; without any, none
/// are. Throws Error (a scene without triangles, device failure, out of memory) and
/// Interrupted.
Bake bakeScene(const CompiledScene& scene, const BakeRequest& request, const Plan& plan, const Device& device,
               Progress& progress, BakeReport& report, BakeCheckpoint* checkpoint = nullptr,
               const Charts* charts = nullptr, const Scene* source = nullptr);

}  // namespace prelight
