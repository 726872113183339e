#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <span>

#include "gi/probes/irradiance_volume.h"
#include "gi/probes/probe_places.h"
#include "gpu/transport_scene.h"
#include "prelight/device.h"
#include "prelight/light_map.h"
#include "prelight/parameters.h"
#include "prelight/progress.h"

namespace prelight {

struct ProbeRequest {
  static constexpr int mostSize = 256, mostOrder = 3;

  int size = 16;              ///< probes along the scene's longest side, 2 to mostSize
  int order = 3;              ///< bands of SH, 1 to mostOrder
  std::uint32_t rays = 4096;  ///< a probe, shared among 50 normals; 256 to 8192
  std::uint64_t seed = 0;
};

template <>
std::span<const Parameter<ProbeRequest>> parametersOf<ProbeRequest>();

struct ProbeReport {
  ProbePlacement placement;
  std::uint64_t rays = 0;
};

/// Light at a grid of points in the air around a lit scene. Indirect light is gathered from the scene's light
/// map, as a light map's own is; what comes straight from lamps and the sky is found by shadow rays. Caustics
/// do not come: no photon lands in the air. Irradiance is taken at 50 normals whose sums are integrals
/// (Lebedev 1976, exact up to degree 11), so that its SH are those of all light that the normals get.
/// `irradiance`: of the light map's texels, [y][x], W/m2. Throws UsageError for a request that makes no
/// sense, Interrupted.
IrradianceVolume gatherProbes(const LitScene& lit, const LightMapLayout& layout,
                              std::span<const glm::vec3> irradiance, const ProbeRequest& request,
                              const Device& device, Progress& progress, ProbeReport& report);

}  // namespace prelight
