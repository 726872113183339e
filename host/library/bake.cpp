#include "prelight/bake.h"

#include <optional>

#include "bake/make_plan.h"
#include "base/resumable_run.h"
#include "io/baked_sky.h"
#include "library/kept_bake.h"
#include "library/library_call.h"
#include "library/run_bake.h"
#include "plan/check_request.h"

namespace prelight {
namespace {

/// Returns the sky that light was baked under, without a name, unless the scene's file holds it.
std::optional<BakedSky> bakedSky(const LoadedScene& scene, const BakeRequest& request) {
  const std::shared_ptr<const Environment>& sky = request.radiosity.environment;
  if (sky == nullptr || sky == scene.sky || !(request.radiosity || request.lightMap)) return std::nullopt;
  return BakedSky{"", request.radiosity.skyRotation, skyHash(*sky)};
}

}  // namespace

Plan plan(const LoadedScene& scene, const BakeRequest& request) {
  return makePlan(scene.scene, scene.compiled, request);
}

BakeResult bakeKeeping(const LoadedScene& scene, const BakeRequest& request, const BakeOptions& options,
                       const StateKey& key, const AddToBake& add) {
  checkRequest(request);
  requireUse(request);
  LibraryCall call(options.device, options.progress);
  Steps steps(call.progress());
  std::optional<ResumableRun> state;
  if (!options.checkpoint.empty()) state.emplace(options.checkpoint, "bake", options.checkpointInterval);
  Progress* progress = &call.progress();
  const auto keyed = [&](StateKey whole) -> Progress& {
    whole.insert(whole.end(), key.begin(), key.end());
    if (state) progress = &state->begin(whole, call.progress(), true);
    return *progress;
  };
  const auto device = [&]() -> const Device& { return call.device(); };
  BakeRun run =
      runBake({scene.path, *scene.document, scene.scene, scene.compiled}, request, {steps, device, keyed});
  run.bake.info.sky = bakedSky(scene, request);
  BakeResult result{std::move(run.bake), std::move(run.report)};
  if (add) add(result, call.device(), *progress);
  if (!state) return result;
  if (const std::string failure = state->failure(); !failure.empty())
    result.report.notes.push_back("the state of the bake could not be kept: " + failure);
  state->remove();
  return result;
}

BakeResult bake(const LoadedScene& scene, const BakeRequest& request, const BakeOptions& options) {
  return bakeKeeping(scene, request, options);
}

}  // namespace prelight
