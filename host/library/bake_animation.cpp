#include "prelight/bake_animation.h"

#include "bake/animated_bake.h"
#include "library/library_call.h"
#include "prelight/error.h"
#include "prelight/load.h"
#include "prelight/parameters.h"
#include "scene/pose.h"

namespace prelight {

void bakeKeys(const LoadedScene& scene, const BakeRequest& request, const AnimationKeys& keys,
              BakeResult& baked, const BakeOptions& options) {
  if (!baked.bake.sh)
    throw UsageError("AnimationKeys", "keys carry SH transfer, and none is baked",
                     "give ShRequest::order a number above 0");
  if (request.chartTransfer.size > 0)
    throw UsageError("AnimationKeys", "keys have no light maps", "leave out ChartTransferRequest::size");
  requireRanges(keys);
  const KeyRequest asked{.count = keys.count, .error = keys.error, .mostKeys = AnimationKeys::mostKeys};
  const std::size_t animation = findAnimation(scene.scene, keys.animation.empty() ? "0" : keys.animation);
  LibraryCall call(options.device, options.progress);
  AnimationReport report;
  baked.bake.animation = bakeAnimation(scene.scene, scene.compiled, animation, request, asked, *baked.bake.sh,
                                       call.device(), call.progress(), report);
  baked.bake.info.rays += report.rays;
  baked.report.notes.insert(baked.report.notes.end(), report.notes.begin(), report.notes.end());
}

}  // namespace prelight
