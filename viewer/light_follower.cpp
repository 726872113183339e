#include "viewer/light_follower.h"

namespace prelight::viewer {

bool shinesAs(const Light& a, const Light& b) {
  return a.type == b.type && a.intensity == b.intensity && a.position == b.position &&
         a.direction == b.direction && a.range == b.range && a.innerConeAngle == b.innerConeAngle &&
         a.outerConeAngle == b.outerConeAngle && a.profile == b.profile && a.side == b.side;
}

}  // namespace prelight::viewer
