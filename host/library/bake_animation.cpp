#include "prelight/bake_animation.h"

#include "bake/animated_bake.h"
#include "library/kept_bake.h"
#include "library/library_call.h"
#include "prelight/error.h"
#include "prelight/load.h"
#include "prelight/parameters.h"
#include "scene/pose.h"

namespace prelight {

namespace {

KeyRequest keyRequest(const AnimationKeys& keys) {
  requireRanges(keys);
  return {.count = keys.count, .error = keys.error, .mostKeys = AnimationKeys::mostKeys};
}

void requireSh(const BakeRequest& request, bool baked) {
  if (!baked)
    throw UsageError("AnimationKeys", "keys hold SH transfer, which is not baked",
                     "give ShRequest::order a number above 0");
  if (request.chartTransfer.size > 0)
    throw UsageError("AnimationKeys", "keys have no light maps", "leave out ChartTransferRequest::size");
}

void addKeys(const LoadedScene& scene, const BakeRequest& request, std::size_t animation,
             const KeyRequest& keys, BakeResult& baked, const Device& device, Progress& progress) {
  AnimationReport report;
  baked.bake.animation = bakeAnimation(scene.scene, scene.compiled, animation, request, keys, *baked.bake.sh,
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

}  // namespace prelight
