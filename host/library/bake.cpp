#include "prelight/bake.h"

#include <optional>

#include "bake/make_plan.h"
#include "library/file_checkpoint.h"
#include "library/library_call.h"
#include "library/run_bake.h"

namespace prelight {

Plan plan(const LoadedScene& scene, const BakeRequest& request) {
  return makePlan(scene.scene, scene.compiled, request);
}

BakeResult bake(const LoadedScene& scene, const BakeRequest& request, const BakeOptions& options) {
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
  return {std::move(run.bake), std::move(run.report)};
}

}  // namespace prelight
