#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <span>

#include "gi/probes/irradiance_volume.h"
#include "gpu/tracer.h"
#include "gpu/transport_scene.h"
#include "prelight/compiled_scene.h"
#include "prelight/device.h"
#include "prelight/light_map.h"
#include "prelight/options.h"
#include "prelight/progress.h"

namespace prelight {

/// Statistics of placing probes.
struct ProbePlacement {
  std::size_t moved = 0;   ///< moved out of objects
  std::size_t inside = 0;  ///< stayed inside and are not valid
};

/// Sets the places of a volume's probes, whether they are valid, and their surfaces. The grid must be set. A
/// probe that sees backs of one-sided surfaces in at least a quarter of all directions lies in an object: it
/// is moved through the nearest back, by at most half a cell, or is not valid.
ProbePlacement placeProbes(const CompiledScene& scene, Tracer& tracer, IrradianceVolume& volume,
                           Progress& progress);

/// Options of gatherProbes().
struct ProbeRequest {
  static constexpr int mostSize = 256, mostOrder = 3;

  int size = 16;              ///< probes along the scene's longest side, 2 to mostSize
  int order = 3;              ///< bands of SH, 1 to mostOrder
  std::uint32_t rays = 4096;  ///< per probe, shared among 50 normals; 256 to 8192
  std::uint64_t seed = 0;
};

template <>
std::span<const Option<ProbeRequest>> optionsOf<ProbeRequest>();

/// Statistics of gatherProbes().
struct ProbeReport {
  ProbePlacement placement;
  std::uint64_t rays = 0;
};

/// Computes light at a grid of points in the air of a lit scene. Indirect light is gathered from the scene's
/// light map, as for a light map itself; direct light of lamps and the sky is found by shadow rays. Caustics
/// are missing, since no photon lands in the air. Irradiance is sampled at 50 normals that form a quadrature
/// (Lebedev 1976, exact up to degree 11) and projected to SH. `irradiance` is that of the light map's texels,
/// [y][x], W/m2. Throws UsageError for an invalid request, and Interrupted.
IrradianceVolume gatherProbes(const LitScene& lit, const LightMapLayout& layout,
                              std::span<const glm::vec3> irradiance, const ProbeRequest& request,
                              const Device& device, Progress& progress, ProbeReport& report);

}  // namespace prelight
