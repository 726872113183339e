#pragma once

#include <span>
#include <vector>

#include "photon/density_surface.h"
#include "shared/density_types.h"
#include "shared/photon_types.h"

namespace prelight {

/// Photons sorted into a map for each side of each region of the surface (Larsen 2004, ch. 8), or of each
/// patch of a region that walls part; each map is a balanced tree over blocks of up to 8. Plain data for the
/// device.
struct PhotonMaps {
  std::vector<device::LeafTree> trees;      ///< [region, or patch of one][front, back]
  std::vector<float> boxes;                 ///< [node of all trees][lower 3, upper 3]
  std::vector<device::PhotonBlock> blocks;  ///< [leaf of all trees]
  std::size_t photonCount = 0;
};

/// Map of every photon: region of the surface that it landed on, twice, and 1 more on the back. Throws as
/// makePhotonMaps.
std::vector<std::uint32_t> mapsOfPhotons(std::span<const device::Photon> photons,
                                         const DensitySurface& surface);

/// Depends on nothing but the photons and their order, whatever the number of threads. Throws InputError for
/// a photon whose position or power is not finite, whose power is negative or whose triangle there is not.
PhotonMaps makePhotonMaps(std::span<const device::Photon> photons, const DensitySurface& surface);

/// Maps of photons that are assigned already. mapOf: [photon], as mapsOfPhotons(); `patches`: regions or
/// patches that they lie on.
PhotonMaps makePhotonMaps(std::span<const device::Photon> photons, std::span<const std::uint32_t> mapOf,
                          std::size_t patches);

}  // namespace prelight
