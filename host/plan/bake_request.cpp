#include "plan/bake_request.h"

#include <algorithm>

namespace prelight {

namespace {

constexpr int haarBounceOrder = 6;  // bands that carry what bounces add to wavelets

}  // namespace

BakeRequest BakeRequest::withoutTechniques() const {
  BakeRequest request = *this;
  request.ao = request.lightGroups = request.occluders = request.radiosity = request.lightMap =
      request.caustics = false;
  request.shOrder = request.chOrder = request.haarSize = request.glossyOrder = 0;
  request.volumeSize = request.texelSize = 0;
  request.namedGroups.clear();
  return request;
}

int transferOrder(const BakeRequest& request) {
  return std::max({request.shOrder, request.chOrder, request.glossyOrder,
                   request.haarSize > 0 && request.bounces > 0 ? haarBounceOrder : 0});
}

int castOrder(const BakeRequest& request) {
  return std::max(transferOrder(request), 2 * request.glossyOrder - 1);
}

}  // namespace prelight
