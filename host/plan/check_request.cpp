#include "plan/check_request.h"

#include <fmt/format.h>

#include <utility>

#include "plan/cast_orders.h"
#include "prelight/error.h"
#include "prelight/options.h"

namespace prelight {

namespace {

void checkLimits(const OcclusionLimits& limits) {
  if (limits.farthest > 0.0 && limits.nearest >= limits.farthest)
    throw UsageError("OcclusionLimits::nearest",
                     fmt::format("got {}, expected less than OcclusionLimits::farthest, {}", limits.nearest,
                                 limits.farthest));
}

void requireLightMap(const BakeRequest& request) {
  const LightMapRequest& map = request.lightMap;
  if (map) return;
  for (const auto& [given, field] : {std::pair{map.photons > 0, "LightMapRequest::photons"},
                                     std::pair{map.texelSize > 0.0, "LightMapRequest::texelSize"},
                                     std::pair{map.error > 0.0, "LightMapRequest::error"},
                                     std::pair{map.denoise, "LightMapRequest::denoise"},
                                     std::pair{map.caustics, "LightMapRequest::caustics"},
                                     std::pair{bool(request.encodedLight), "EncodedLightRequest::encodings"}})
    if (given)
      throw UsageError(field, "it applies to light maps, and none is asked for",
                       "ask for BakeRequest::lightMap");
}

}  // namespace

void checkRequest(const BakeRequest& request) {
  requireRanges(request);
  checkLimits(request.limits);
  if (request.effort.error && request.effort.seconds)
    throw UsageError("Effort::error", "it excludes Effort::seconds", "give one of the two");
}

void requireUse(const BakeRequest& request) {
  if (request.chartTransfer.relief && request.chartTransfer.size == 0)
    throw UsageError("ChartTransferRequest::relief",
                     "it applies to transfer at texels, which is not asked for",
                     "ask for ChartTransferRequest::size");
  if (request.volume.size > 0) requireShOrder(request, "VolumeRequest::size");
  if (request.chartTransfer.size > 0) requireShOrder(request, "ChartTransferRequest::size");
  requireLightMap(request);
}

}  // namespace prelight
