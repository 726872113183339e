#pragma once

#include <cstdint>
#include <vector>

#include "gpu/light_tables.h"
#include "prelight/bake.h"
#include "prelight/compiled_scene.h"
#include "prelight/plan.h"
#include "shared/light_group_types.h"

namespace prelight {

/// The scene's own lights, dealt to groups, as kernels/cast/light_kernels.cl reads them.
struct GroupedLights {
  std::vector<LightGroup> groups;
  LightTables tables;  ///< punctual lights of intensities over their groups' colours; emitters group by group
  std::vector<device::GroupEmitter> emitters;    ///< [emitter of the tables]
  std::vector<std::uint32_t> emitterOfTriangle;  ///< [triangle], or PRELIGHT_NO_EMITTER; of whole ones
  std::vector<std::uint32_t> samplesOfGroup;     ///< [group], emitter samples a receiver
  std::vector<device::LightRay> rays;            ///< shadow rays of a receiver

  bool empty() const { return groups.empty(); }
};

/// The punctual lights of all groups alone, and the emitters alone, of which a receiver then has as many
/// samples a group as are given.
GroupedLights punctualLightsOf(GroupedLights lights);
GroupedLights emittersOf(GroupedLights lights, std::uint32_t samples);

/// Deals lights and emissive nodes to the groups that are named, in their order, and every other one to a
/// group of its own: punctual lights first, then nodes, each in the file's order. Throws UsageError for a
/// named group that no light matches, InputError when nothing in the scene shines.
GroupedLights groupLights(const CompiledScene& scene, const std::vector<LightGroupRequest>& named);

/// How many groups there would be, and shadow rays of a receiver. Asks nothing of the names.
struct LightCounts {
  std::uint64_t groups = 0;
  std::uint64_t rays = 0;
};

LightCounts countLights(const CompiledScene& scene, const std::vector<LightGroupRequest>& named);

}  // namespace prelight
