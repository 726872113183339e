#include "prelight/bake.h"

#include <optional>

#include "bake/make_plan.h"
#include "io/baked_sky.h"
#include "library/file_checkpoint.h"
#include "library/library_call.h"
#include "library/run_bake.h"
#include "plan/check_request.h"

namespace prelight {
namespace {

/// The sky that light was baked under, unless the scene's file holds it. It has no name here.
std::optional<BakedSky> bakedSky(const LoadedScene& scene, const BakeRequest& request) {
  const std::shared_ptr<const Environment>& sky = request.radiosity.environment;
  if (sky == nullptr || sky == scene.sky || !(request.radiosity || request.lightMap)) return std::nullopt;
  return BakedSky{"", request.radiosity.skyRotation, skyHash(*sky)};
}

}  // namespace

Plan plan(const LoadedScene& scene, const BakeRequest& request) {
  return makePlan(scene.scene, scene.compiled, request);
}

BakeResult bake(const LoadedScene& scene, const BakeRequest& request, const BakeOptions& options) {
  checkRequest(request);
  requireUse(request);
  LibraryCall call(options.device, options.progress);
  Steps steps(call.progress());
  std::optional<FileCheckpoint> checkpoint;
  if (!options.checkpoint.empty()) checkpoint.emplace(options.checkpoint);
  const auto keyed = [&](const StateKey& key) -> BakeCheckpoint* {
    if (!checkpoint) return nullptr;
    checkpoint->setKey(key);
    return &*checkpoint;
  };
  const auto device = [&]() -> const Device& { return call.device(); };
  BakeRun run =
      runBake({scene.path, *scene.document, scene.scene, scene.compiled}, request, {steps, device, keyed});
  if (checkpoint) {
    checkpoint->remove();
    if (!checkpoint->failure().empty())
      run.report.notes.push_back("the state of the bake could not be kept: " + checkpoint->failure());
  }
  run.bake.info.sky = bakedSky(scene, request);
  return {std::move(run.bake), std::move(run.report)};
}

}  // namespace prelight
