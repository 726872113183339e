#include "prelight/bake_animation.h"

#include <fmt/format.h>

#include "bake/animated_bake.h"
#include "library/library_call.h"
#include "prelight/error.h"
#include "prelight/load.h"
#include "scene/pose.h"

namespace prelight {

namespace {

KeyRequest keyRequest(const AnimationKeys& keys) {
  KeyRequest request{.count = keys.count, .error = keys.error};
  if (keys.error) {
    requireBetween("AnimationKeys::error", *keys.error, 1e-6, 1.0);
    return request;
  }
  requireBetween("AnimationKeys::count", keys.count, 1, request.mostKeys);
  return request;
}

}  // namespace

void bakeKeys(const LoadedScene& scene, const BakeRequest& request, const AnimationKeys& keys,
              BakeResult& baked, const BakeOptions& options) {
  if (!baked.bake.sh)
    throw UsageError("AnimationKeys", "keys carry SH transfer, and none is baked",
                     "give ShRequest::order a number above 0");
  if (request.chartTransfer.size > 0)
    throw UsageError("AnimationKeys", "keys have no light maps", "leave out ChartTransferRequest::size");
  const KeyRequest asked = keyRequest(keys);
  const std::size_t animation = findAnimation(scene.scene, keys.animation.empty() ? "0" : keys.animation);
  LibraryCall call(options.device, options.progress);
  AnimationReport report;
  baked.bake.animation = bakeAnimation(scene.scene, scene.compiled, animation, request, asked, *baked.bake.sh,
                                       call.device(), call.progress(), report);
  baked.bake.info.rays += report.rays;
  baked.report.notes.insert(baked.report.notes.end(), report.notes.begin(), report.notes.end());
}

}  // namespace prelight
