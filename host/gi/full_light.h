#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "base/progress.h"
#include "gi/indirect_light.h"
#include "photon/caustic_filter.h"
#include "plan/plan.h"
#include "scene/scene.h"
#include "shared/photon_types.h"
#include "transfer/light_map_layout.h"

namespace prelight {

struct FullLightRequest {
  std::uint32_t texels = 1u << 13;                    ///< of the map of indirect light, about
  IndirectRequest indirect{.directByPhotons = true};  ///< as frames of LiveLight, which go on from here
  std::uint64_t causticPhotons = 100000;              ///< that leave lights towards what makes caustics
  std::uint64_t seed = 0;
};

/// The light that pictures look up in full shading, but for direct light: computed once for a scene and its
/// lights.
struct FullLight {
  LightMap indirect;                    ///< of one coefficient; no values but 0 where nothing shines
  std::vector<device::Photon> photons;  ///< of caustics
  CausticFilter filter;                 ///< of `photons`
  std::vector<PlannedPass> plan;
  std::vector<std::pair<std::string, double>> stageSeconds;
  PhotonReport indirectPhotons, causticPhotons;
  std::uint64_t rays = 0;
};

/// Sets the values of a light map of one coefficient from those of its places. Places that get none at all
/// lie inside an object, or in the dark; they take after their neighbours on the chart.
void setIrradiance(std::span<const glm::vec3> irradiance, LightMap& map);

/// Throws UsageError when the light map would be too large, Interrupted between blocks.
FullLight makeFullLight(const Scene& scene, const LitScene& lit, const FullLightRequest& request,
                        const Device& device, Progress& progress);

}  // namespace prelight
