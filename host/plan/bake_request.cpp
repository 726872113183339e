#include "prelight/request.h"

#include <algorithm>

#include "plan/cast_orders.h"
#include "prelight/error.h"

namespace prelight {

namespace {

constexpr int haarBounceOrder = 6;  // bands by which light of bounces, mirrors and glass is added to wavelets

/// Returns whether wavelets get part of their light through SH.
bool hasSmoothHaar(const BakeRequest& request) {
  return request.haar.size > 0 && (request.bounces > 0 || request.specular || request.subsurface);
}

}  // namespace

BakeRequest BakeRequest::withoutTechniques() const {
  BakeRequest request = *this;
  request.ao = request.cones = false;
  request.sh = {};
  request.horizons.sectors = request.ch.order = request.nearLamps.shells = request.haar.size =
      request.glossy.order = request.volume.size = request.chartTransfer.size = 0;
  request.lightGroups = {};
  request.occluders.wanted = request.radiosity.wanted = false;
  request.lightMap.wanted = request.lightMap.caustics = false;
  request.encodedLight = {};
  return request;
}

int transferOrder(const BakeRequest& request) {
  return std::max({request.sh.order, request.ch.order, request.glossy.order,
                   hasSmoothHaar(request) ? haarBounceOrder : 0});
}

int nearLampOrder(const BakeRequest& request) { return std::max(request.sh.order, request.ch.order); }

int castOrder(const BakeRequest& request) {
  return std::max(transferOrder(request), 2 * request.glossy.order - 1);
}

void requireShOrder(const BakeRequest& request, const char* field) {
  if (request.sh.order == 0)
    throw UsageError(field, "it has the order of the SH transfer, which is not asked for",
                     "set ShRequest::order");
}

}  // namespace prelight
