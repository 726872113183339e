#include "basis/lights/lamp_through_transfer.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace prelight {

namespace {

constexpr double leastOpen = 1e-4;

}  // namespace

ArrivingLamp arrivingLamp(const SeenLamp& lamp, const glm::dvec3& through, double open, double slope) {
  if (std::abs(open) < leastOpen) open = leastOpen;
  if (lamp.isSoft) slope = 1.0;
  const glm::dvec3 share = glm::clamp(through / open, 0.0, 1.0);
  return {glm::clamp(0.5 + slope * (share - 0.5), 0.0, 1.0), through - share * open};
}

glm::dvec3 lampThroughTransfer(const SeenLamp& lamp, const glm::dvec3& through, double open, bool sharp) {
  const ArrivingLamp arriving = arrivingLamp(lamp, through, open, sharp ? shadowSlope : 1.0);
  const double facing = std::max(lamp.cosine, 0.0) / std::numbers::pi;
  return glm::max(lamp.irradiance * (arriving.bounced + arriving.direct * facing), 0.0);
}

}  // namespace prelight
