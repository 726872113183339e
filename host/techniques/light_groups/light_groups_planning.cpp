#include "techniques/light_groups/light_groups_planning.h"

namespace prelight {

namespace {

std::vector<PlannedPass> lightGroupsPasses(const PlanInput& input) {
  if (!input.request.lightGroups) return {{Pass::LightGroups, false, "not asked for"}};
  return {{Pass::LightGroups, true, "shadow rays from every receiver to every light"}};
}

const char* closestHitsOfSome(const BakeRequest& request) {
  return request.lightGroups ? "closest hits where a group has emitters" : nullptr;
}

void addLightGroupsToKey(const BakeRequest& request, StateHash& hash) {
  hash.value(request.lightGroups.wanted);
}

void addListsToKey(const BakeRequest& request, StateHash& hash) {
  for (const LightGroupRequest& group : request.lightGroups.named) {
    hash.text(group.name);
    for (const std::string& pattern : group.patterns) hash.text(pattern);
  }
}

}  // namespace

Planning lightGroupsPlanning() {
  return {.passes = lightGroupsPasses,
          .closestHitsOfSome = closestHitsOfSome,
          .addToKey = addLightGroupsToKey,
          .addListsToKey = addListsToKey};
}

}  // namespace prelight
