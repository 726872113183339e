#pragma once

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

#include "photon/photon_sources.h"

namespace prelight {

/// Photons of one source in groups with similar initial directions, so that one photon represents its group
/// (Dmitriev et al. 2002; Larsen 2004, ch. 9).
struct PhotonGroups {
  std::vector<std::uint32_t> photons;  ///< group after group of equal size; the last may be smaller
  std::uint32_t size = 1;

  std::uint32_t count() const { return static_cast<std::uint32_t>((photons.size() + size - 1) / size); }
  std::span<const std::uint32_t> group(std::uint32_t index) const {
    const std::size_t first = std::size_t{index} * size;
    return std::span(photons).subspan(first, std::min<std::size_t>(size, photons.size() - first));
  }
};

/// Divides a source's photons into groups of `size` >= 1 along a Hilbert curve through the square of
/// directions, so that groups are compact for any number of photons.
PhotonGroups makePhotonGroups(const device::PhotonSource& source, std::span<const device::SourceCell> cells,
                              std::uint32_t size);

}  // namespace prelight
