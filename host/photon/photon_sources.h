#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "gpu/light_tables.h"
#include "prelight/compiled_scene.h"
#include "scene/camera_axes.h"
#include "shared/photon_path_types.h"

namespace prelight {

/// Where photons that carry little end by chance.
struct LeastPower {
  device::ImportanceGrid grid{};
  std::vector<float> watts;  ///< [z][y][x], above 0: those of less go on with so much, or end
};

/// What photons start from, and how much of their directions.
struct PhotonSources {
  std::vector<device::PhotonSource> sources;  ///< those with photons
  std::vector<double> powers;                 ///< [source] luminance of its power, W
  std::vector<device::SourceCell> cells;      ///< of the directions, source by source; see PhotonSource
  glm::dvec3 centre{0.0};  ///< scene coordinates; light from afar covers the sphere of this radius around it
  double radius = 0.0;
  std::optional<CameraAxes> eye;    ///< that importons leave
  std::optional<LeastPower> least;  ///< none: power decides where photons go on
};

/// Of source `source`, so that sources are independent of one another.
std::uint32_t seedOfSource(std::uint64_t seed, std::size_t source);

/// Every light of a scene, with photons in proportion to power: about `photons`, at least one a light.
PhotonSources allSources(const CompiledScene& scene, const LightTables& lights, std::uint64_t photons,
                         std::uint64_t seed);

/// The lights again, with photons only towards triangles that make caustics (Jensen's projection maps): a
/// conservative choice of cells for lights that are near, a disc around them for light from afar. Powers are
/// still the lights' own. Without such triangles there is no source.
PhotonSources sourcesTowards(const CompiledScene& scene, const LightTables& lights,
                             const std::vector<std::uint32_t>& triangles, std::uint64_t photons,
                             std::uint64_t seed);

/// The same towards all that makes caustics.
PhotonSources sourcesTowardsCasters(const CompiledScene& scene, const LightTables& lights,
                                    std::uint64_t photons, std::uint64_t seed);

}  // namespace prelight
