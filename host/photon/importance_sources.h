#pragma once

#include <span>

#include "photon/importance_map.h"
#include "photon/photon_sources.h"

namespace prelight {

/// Of a photon over the mean of all, at most.
constexpr double boundOfPower = 8.0;

/// Every light of a scene with its square of directions (of light from afar: of places) cut into cells, for
/// photons that find out which of them matter. Light from afar is cut around `middle`.
PhotonSources pilotSources(const CompiledScene& scene, const LightTables& lights, const glm::dvec3& middle,
                           std::uint64_t photons, std::uint64_t seed);

/// The same sources with about `photons` shared out among cells by what their pilots brought: [path of a
/// pilot], what a picture gets of it. An eighth of the photons is shared out by power, so that none carries
/// more than eight times as much as all do in the mean. Empty where the pilots brought nothing.
PhotonSources sourcesByImportance(const PhotonSources& pilots, std::span<const double> brought,
                                  std::uint64_t photons, std::uint64_t seed);

}  // namespace prelight
