#include "techniques/volume/volume_planning.h"

#include <fmt/format.h>

namespace prelight {

namespace {

/// Values a voxel, without those of light groups: with bounces, three channels, what is direct, and what
/// surfaces send in three channels by four functions of direction.
std::uint64_t valuesOf(const PlanInput& input) {
  const int order = input.request.sh.order;
  return static_cast<std::uint64_t>(order * order) * (input.bounces ? 3 + 1 + 3 * 4 : 1);
}

/// What a light group adds to a voxel.
std::string lightsText(const PlanInput& input) {
  return input.bounces && input.request.lightGroups ? ", 108 more per light group" : "";
}

std::vector<PlannedPass> volumePasses(const PlanInput& input) {
  const BakeRequest& request = input.request;
  if (request.volume.size == 0) return {{Pass::Volume, false, "not asked for"}};
  if (request.sh.order == 0)
    return {{Pass::Volume, false, "it has the order of the SH transfer, which is not asked for"}};
  return {
      {Pass::Volume, true,
       fmt::format("{} voxels along the longest side, order {}, {}{}, {} bytes per voxel{}; moving objects "
                   "are not in it, and everything in the scene shadows it",
                   request.volume.size, request.sh.order, plannedChannels(input.bounces),
                   input.bounces ? " and one without bounces" : "", 4 * valuesOf(input), lightsText(input))}};
}

void addVolumeMemory(const PlanInput& input, Plan& plan) {
  const auto side = static_cast<std::uint64_t>(input.request.volume.size);
  plan.hostBytes += side * side * side * (4 * valuesOf(input) + 1);
}

void addVolumeToKey(const BakeRequest& request, StateHash& hash) { hash.value(request.volume.size); }

}  // namespace

Planning volumePlanning() {
  return {.passes = volumePasses, .addMemory = addVolumeMemory, .addToKey = addVolumeToKey};
}

}  // namespace prelight
