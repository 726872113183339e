#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "gpu/light_tables.h"
#include "prelight/compiled_scene.h"
#include "scene/camera.h"
#include "scene/lobes.h"
#include "shared/photon_path_types.h"

namespace prelight {

/// Returns the triangles whose materials make caustics (makesCaustics()).
std::vector<std::uint32_t> causticCasters(const CompiledScene& scene);

/// Returns the triangles of mirrors and smooth glass (scattersSharply()).
std::vector<std::uint32_t> sharpCasters(const CompiledScene& scene);

/// Thresholds of power below which photons undergo Russian roulette.
struct LeastPower {
  device::ImportanceGrid grid{};
  std::vector<float> watts;  ///< [z][y][x], > 0: photons below it continue with this power or end
};

/// Emitters of photons, with the cells of directions that they use.
struct PhotonSources {
  std::vector<device::PhotonSource> sources;  ///< sources with photons
  std::vector<double> powers;                 ///< [source], luminance of the power, W
  std::vector<device::SourceCell> cells;      ///< cells of directions, source by source; see PhotonSource
  glm::dvec3 centre{0.0};  ///< scene coordinates; distant light covers the sphere of this radius around it
  double radius = 0.0;
  std::optional<CameraAxes> eye;    ///< emitter of importons
  std::optional<LeastPower> least;  ///< none: power decides where photons end
};

/// Returns the seed of a source, so that sources are independent of one another.
std::uint32_t seedOfSource(std::uint64_t seed, std::size_t source);

/// Returns every light of a scene, with about `photons` photons in proportion to power and at least one per
/// light.
PhotonSources allSources(const CompiledScene& scene, const LightTables& lights, std::uint64_t photons,
                         std::uint64_t seed);

/// Returns the lights with photons only towards triangles that make caustics (Jensen's projection maps):
/// conservatively chosen cells for nearby lights, and a disc around the triangles for distant light. Powers
/// are those of the whole lights. Returns no sources if there are no such triangles.
PhotonSources sourcesTowards(const CompiledScene& scene, const LightTables& lights,
                             const std::vector<std::uint32_t>& triangles, std::uint64_t photons,
                             std::uint64_t seed);

/// Returns the lights with photons only towards objects that make caustics.
PhotonSources sourcesTowardsCasters(const CompiledScene& scene, const LightTables& lights,
                                    std::uint64_t photons, std::uint64_t seed);

}  // namespace prelight
