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
#include "scene/camera.h"

namespace prelight {

// Global illumination in stages: plan, photons, surface, density with final gathering (IndirectLight),
// caustics (CausticMap). Each stage takes plain data from those before it. computeGlobalIllumination() runs
// all of them; light maps (techniques/light_map), incremental updates (gi/update) and OpenGL's caustics call
// the stages that they need.

/// Returns the passes "indirect light" and "caustic photons", in this order, with whether the scene's light
/// needs them and why.
std::vector<PlannedPass> planGlobalIllumination(const CompiledScene& compiled, const TransportScene& scene);

bool runs(std::span<const PlannedPass> plan, Pass pass);

/// The surface that photons land on, and the texels at which light is gathered.
struct LitSurface {
  LightMapCharts charts;
  LightMapLayout layout;  ///< layout of the charts
  DensitySurface density;
};

/// Lays out a surface with a light map of about `texels` texels. Depends on neither lights nor device. Throws
/// UsageError when the map would be too large.
LitSurface layOutSurface(const Scene& source, const CompiledScene& compiled, std::uint32_t texels);

/// Options of computeGlobalIllumination().
struct GlobalIlluminationRequest {
  IndirectRequest indirect;                ///< its seed is used by all stages
  std::uint64_t causticPhotons = 100'000;  ///< photons emitted towards objects that make caustics
  /// If set, photons of indirect light are sent preferably where they contribute to what is seen; none: by
  /// the power of lights.
  std::optional<CameraAxes> eye = {};
  double footprint = 0.0;  ///< m, size of a pixel on surfaces: caustics are no sharper (chooseCausticFilter)
};

/// Light other than direct light, computed once for a scene and its lights, and then looked up.
struct GlobalIllumination {
  std::vector<PlannedPass> plan;  ///< planGlobalIllumination(), and the pass for backs of one-sided surfaces
  LightMap indirect;              ///< one coefficient; all values are 0 where nothing shines
  std::vector<device::Photon> photons;  ///< caustic photons
  CausticMap caustics;                  ///< made of `photons`
  /// [texel of indirect.layout], the patch on which caustics are looked up; empty: photons are sorted by
  /// region.
  std::vector<std::uint32_t> patches;
  DensitySurface surface;  ///< the surface that `photons` lie on
  PhotonReport indirectPhotons, causticPhotons;
  std::size_t gatheredAt = 0;  ///< texels of `indirect` that were gathered at
  std::uint64_t rays = 0;
  std::vector<std::pair<std::string, double>> stageSeconds;
};

/// Runs all stages. `scene` is made of `lit`. `surface` may still be under construction while photons are
/// traced. Throws the exceptions of its construction, and Interrupted between blocks.
GlobalIllumination computeGlobalIllumination(const LitScene& lit, TransportScene& scene,
                                             const GlobalIlluminationRequest& request,
                                             std::future<LitSurface> surface, const Device& device,
                                             Progress& progress);

/// Runs all stages for a scene that is uploaded here, on a surface of about `texels` texels that is laid out
/// here.
GlobalIllumination computeGlobalIllumination(const Scene& source, const LitScene& lit,
                                             const GlobalIlluminationRequest& request, std::uint32_t texels,
                                             const Device& device, Progress& progress);

}  // namespace prelight
