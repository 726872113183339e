#pragma once

#include <span>

#include "photon/importance_map.h"
#include "photon/photon_sources.h"

namespace prelight {

/// Greatest power of a photon relative to the mean.
constexpr double boundOfPower = 8.0;

/// Returns every light of a scene with its square of directions (for distant light: of places) divided into
/// cells, for pilot photons that explore which cells matter. Distant light is divided around `middle`.
PhotonSources pilotSources(const CompiledScene& scene, const LightTables& lights, const glm::dvec3& middle,
                           std::uint64_t photons, std::uint64_t seed);

/// Returns the same sources with about `photons` photons, distributed to cells by the contributions of their
/// pilots to a picture, [path of a pilot]. An eighth of the photons is distributed by power, so that none
/// carries more than eight times the mean. Returns no sources if the pilots contributed nothing.
PhotonSources sourcesByImportance(const PhotonSources& pilots, std::span<const double> brought,
                                  std::uint64_t photons, std::uint64_t seed);

}  // namespace prelight
