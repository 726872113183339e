#include <functional>
#include <optional>

#include "bake/animated_bake.h"
#include "bake/make_plan.h"
#include "base/resumable_run.h"
#include "base/state_file.h"
#include "io/baked_sky.h"
#include "io/scene_fingerprint.h"
#include "library/library_call.h"
#include "library/run_bake.h"
#include "plan/check_request.h"
#include "prelight/bake.h"
#include "prelight/bake_animation.h"
#include "prelight/error.h"
#include "prelight/load.h"
#include "prelight/options.h"
#include "prelight/stale_bake.h"
#include "scene/pose.h"

namespace prelight {

/// A step that adds to a bake, on a device, with a progress that keeps unfinished work.
using AddToBake = std::function<void(BakeResult& baked, const Device& device, Progress& progress)>;

/// Does bake() and then `add` in one run with one checkpoint. `key` holds what the state depends on in
/// addition to the key of bake().
BakeResult bakeKeeping(const LoadedScene& scene, const BakeRequest& request, const BakeOptions& options,
                       const StateKey& key = {}, const AddToBake& add = {});

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
    if (state) progress = &state->begin(whole, call.progress(), StateUse::Continue);
    return *progress;
  };
  const auto device = [&]() -> const Device& { return call.device(); };
  BakeRun run = runBake({scene.path, *scene.document, scene.scene, scene.compiled}, request,
                        {steps, device, keyed, options.hemispheres});
  run.bake.info.sky = bakedSky(scene, request);
  run.bake.info.refined = scene.refined;
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

namespace {

KeyRequest keyRequest(const AnimationKeys& keys) {
  requireRanges(keys);
  return {.count = keys.count, .error = keys.error, .mostKeys = AnimationKeys::mostKeys};
}

void requireSh(const BakeRequest& request, bool baked) {
  if (request.visibility != Visibility::Rays)
    throw UsageError("AnimationKeys", "keys are baked by rays", "leave BakeRequest::visibility at Rays");
  if (!baked)
    throw UsageError("AnimationKeys", "keys hold SH transfer, which is not baked",
                     "give ShRequest::order a number above 0");
  if (request.chartTransfer.size > 0)
    throw UsageError("AnimationKeys", "keys have no light maps", "leave out ChartTransferRequest::size");
}

void addKeys(const LoadedScene& scene, const BakeRequest& request, std::size_t animation,
             const KeyRequest& keys, BakeResult& baked, const Device& device, Progress& progress) {
  AnimationReport report;
  baked.bake.animation = bakeAnimation(scene.scene, scene.compiled, animation, request, keys, baked.bake,
                                       device, progress, report);
  baked.bake.info.rays += report.rays;
  baked.report.notes.insert(baked.report.notes.end(), report.notes.begin(), report.notes.end());
}

std::size_t animationOf(const LoadedScene& scene, const AnimationKeys& keys) {
  return findAnimation(scene.scene, keys.animation.empty() ? "0" : keys.animation);
}

}  // namespace

void bakeKeys(const LoadedScene& scene, const BakeRequest& request, const AnimationKeys& keys,
              BakeResult& baked, const BakeOptions& options) {
  requireSh(request, baked.bake.sh.has_value());
  const KeyRequest asked = keyRequest(keys);
  const std::size_t animation = animationOf(scene, keys);
  LibraryCall call(options.device, options.progress);
  addKeys(scene, request, animation, asked, baked, call.device(), call.progress());
}

BakeResult bakeAnimated(const LoadedScene& scene, const BakeRequest& request, const AnimationKeys& keys,
                        const BakeOptions& options) {
  requireSh(request, request.sh.order > 0);
  const KeyRequest asked = keyRequest(keys);
  const std::size_t animation = animationOf(scene, keys);
  return bakeKeeping(scene, request, options, keysKey(animation, asked),
                     [&](BakeResult& baked, const Device& device, Progress& progress) {
                       addKeys(scene, request, animation, asked, baked, device, progress);
                     });
}

std::optional<std::string> staleBake(const LoadedScene& scene, const Bake& carried) {
  const auto change = changedSinceBake({*scene.document, scene.scene, scene.compiled, carried});
  return change ? std::optional(textOf(*change)) : std::nullopt;
}

}  // namespace prelight
