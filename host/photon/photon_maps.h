#pragma once

#include <span>
#include <vector>

#include "photon/density_surface.h"
#include "shared/density_types.h"
#include "shared/photon_types.h"

namespace prelight {

/// Photons sorted into one map per side of each region of the surface (Larsen 2004, ch. 8), or of each patch
/// of a region divided by walls. Each map is a balanced tree over blocks of up to 8 photons. Plain data for
/// the device.
struct PhotonMaps {
  std::vector<device::LeafTree> trees;      ///< [region or patch][front, back]
  std::vector<float> boxes;                 ///< [node of all trees][lower 3, upper 3]
  std::vector<device::PhotonBlock> blocks;  ///< [leaf of all trees]
  std::size_t photonCount = 0;
};

/// Returns the map of every photon: 2 x region that it landed on, + 1 on the back. Throws as
/// makePhotonMaps().
std::vector<std::uint32_t> mapsOfPhotons(std::span<const device::Photon> photons,
                                         const DensitySurface& surface);

/// Makes the maps of photons by region. The result depends only on the photons and their order, not on the
/// number of threads. Throws InputError for photons with a position or power that is not finite, a negative
/// power or an invalid triangle.
PhotonMaps makePhotonMaps(std::span<const device::Photon> photons, const DensitySurface& surface);

/// Makes the maps of photons that are already assigned. `mapOf` is [photon], as mapsOfPhotons(); `patches` is
/// the number of regions or patches.
PhotonMaps makePhotonMaps(std::span<const device::Photon> photons, std::span<const std::uint32_t> mapOf,
                          std::size_t patches);

}  // namespace prelight
