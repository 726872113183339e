#pragma once

#include <cstdint>
#include <future>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "charts/hidden_light.h"
#include "charts/light_map_charts.h"
#include "gi/indirect_light.h"
#include "photon/caustic_light.h"
#include "prelight/light_map.h"
#include "prelight/plan.h"
#include "prelight/progress.h"
#include "prelight/scene.h"
#include "scene/camera_axes.h"

namespace prelight {

// Global illumination in stages: plan, photons, surface, density with final gathering (IndirectLight),
// caustics (CausticMap). Each takes plain data from those before it. computeGlobalIllumination() runs all of
// them; light maps (projectors/light_map), frames that follow what moves (gi/update) and OpenGL's caustics
// call those that they need.

/// Which of the passes "indirect light" and "caustic photons", in this order, a scene's light needs, and why.
std::vector<PlannedPass> planGlobalIllumination(const CompiledScene& compiled, const TransportScene& scene);

bool runs(std::span<const PlannedPass> plan, Pass pass);

/// The surface that photons land on, and the texels that light is gathered at.
struct LitSurface {
  LightMapCharts charts;
  LightMapLayout layout;  ///< of these
  DensitySurface density;
};

/// With a light map of about `texels`. Depends on no light and no device. Throws UsageError when the map
/// would be too large.
LitSurface layOutSurface(const Scene& source, const CompiledScene& compiled, std::uint32_t texels);

struct GlobalIlluminationRequest {
  IndirectRequest indirect;                ///< its seed is everybody's
  std::uint64_t causticPhotons = 100'000;  ///< that leave lights towards what makes caustics
  /// Photons of indirect light go by preference where they count for what is seen; none: by lights' power.
  std::optional<CameraAxes> eye = {};
  double footprint = 0.0;  ///< m, what a pixel sees: caustics are no sharper (chooseCausticFilter)
};

/// Light that is computed once for a scene and its lights, and then looked up: all but direct light.
struct GlobalIllumination {
  std::vector<PlannedPass> plan;        ///< planGlobalIllumination(), and the backs of one-sided surfaces
  LightMap indirect;                    ///< of one coefficient; no values but 0 where nothing shines
  std::vector<device::Photon> photons;  ///< of caustics
  CausticMap caustics;                  ///< of these
  /// [texel of indirect.layout] the patch that caustics are looked up on; empty: they are sorted by region.
  std::vector<std::uint32_t> patches;
  DensitySurface surface;  ///< that they lie on
  PhotonReport indirectPhotons, causticPhotons;
  std::size_t gatheredAt = 0;  ///< texels of `indirect` that rays left from
  std::uint64_t rays = 0;
  std::vector<std::pair<std::string, double>> stageSeconds;
};

/// Runs all stages. `scene` is made of `lit`. `surface`: may still be in the making, when photons fly
/// meanwhile. Throws what making it does, and Interrupted between blocks.
GlobalIllumination computeGlobalIllumination(const LitScene& lit, TransportScene& scene,
                                             const GlobalIlluminationRequest& request,
                                             std::future<LitSurface> surface, const Device& device,
                                             Progress& progress);

/// With a scene on the device and a surface of about `texels` of its own.
GlobalIllumination computeGlobalIllumination(const Scene& source, const LitScene& lit,
                                             const GlobalIlluminationRequest& request, std::uint32_t texels,
                                             const Device& device, Progress& progress);

}  // namespace prelight
