#include "prelight/techniques.h"

#include <algorithm>

#include "plan/cast_orders.h"
#include "prelight/error.h"

namespace prelight {

namespace {

constexpr int ownLampOrder = 6;     // bands of near lamps beside transfer in other bases than SH and CH
constexpr int haarBounceOrder = 6;  // bands by which light of bounces, mirrors and glass is added to wavelets

/// Returns whether wavelets get part of their light through SH.
bool hasSmoothHaar(const BakeRequest& request) {
  return request.haar.size > 0 && (request.bounces > 0 || request.specular || request.subsurface);
}

}  // namespace

BakeRequest BakeRequest::withoutTechniques() const {
  return {.bounces = bounces,
          .specular = specular,
          .glossyBounces = glossyBounces,
          .subsurface = subsurface,
          .visibility = visibility,
          .limits = limits,
          .shadowSets = shadowSets,
          .effort = effort,
          .seed = seed,
          .maxMemory = maxMemory};
}

int transferOrder(const BakeRequest& request) {
  return std::max({request.sh.order, request.ch.order, request.glossy.order,
                   hasSmoothHaar(request) ? haarBounceOrder : 0});
}

int nearLampOrder(const BakeRequest& request) {
  const int order = std::max(request.sh.order, request.ch.order);
  const bool wanted = order > 0 || request.haar.size > 0 || request.glossy.order > 0;
  if (wanted && request.nearLamps.order > 0) return request.nearLamps.order;
  return wanted && order == 0 ? ownLampOrder : order;
}

int castOrder(const BakeRequest& request) {
  return std::max(transferOrder(request), 2 * request.glossy.order - 1);
}

void requireShOrder(const BakeRequest& request, const char* field) {
  if (request.sh.order == 0)
    throw UsageError(field, "it has the order of the SH transfer, which is not asked for",
                     "set ShRequest::order");
}

}  // namespace prelight
