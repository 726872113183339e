#include "techniques/near_lamps/lamp_shells.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "basis/sh.h"
#include "basis/sh_zonal.h"
#include "compress/small_floats.h"

namespace prelight {

namespace {

constexpr double nearestShare = 1.0 / 64.0;  // relative to the diagonal
constexpr double leastOpen = 1e-4;           // smaller values are behind the horizon, where no light counts
constexpr double shadowSlope = 3.0;

}  // namespace

ShellRange shellRange(const CompiledScene& scene, const NearLampsRequest& request) {
  const double farthest = request.farthest > 0.0
                              ? request.farthest
                              : glm::length(glm::dvec3(scene.boundsMax) - glm::dvec3(scene.boundsMin));
  return {nearestShare * farthest, farthest};
}

double shellStart(const NearLampTransfer& transfer, int shell) {
  return transfer.nearest * std::pow(transfer.farthest / transfer.nearest, double(shell) / transfer.shells);
}

double shareBefore(const NearLampTransfer& transfer, int shell, double distance) {
  if (!(distance > 0.0)) return 0.0;
  const double place = transfer.shells * std::log(distance / transfer.nearest) /
                       std::log(transfer.farthest / transfer.nearest);
  return std::clamp(place - shell - shellLag, 0.0, 1.0);
}

double lampVisibility(const NearLampTransfer& transfer, std::size_t vertex, const glm::dvec3& normal,
                      const glm::dvec3& toLamp, double distance) {
  const std::size_t columns = transfer.columns(), shells = static_cast<std::size_t>(transfer.shells);
  std::vector<double> basis(columns);
  sh::evaluate(toLamp, transfer.order, basis);
  const double all = sh::openTowards(glm::dot(normal, toLamp), transfer.order);
  double blocked = 0.0;
  for (std::size_t shell = 0; shell < shells; ++shell) {
    const double share = shareBefore(transfer, static_cast<int>(shell), distance);
    const std::size_t row = (vertex * shells + shell) * columns;
    for (std::size_t i = 0; share > 0.0 && i < columns; ++i)
      blocked += share * basis[i] * double(fromHalf(transfer.halves[row + i]));
  }
  return all > leastOpen ? std::clamp(1.0 - blocked / all, 0.0, 1.0) : 1.0;
}

double sharpened(double visibility) { return std::clamp(0.5 + shadowSlope * (visibility - 0.5), 0.0, 1.0); }

}  // namespace prelight
