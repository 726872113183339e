#pragma once

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

#include "photon/photon_sources.h"

namespace prelight {

/// Photons of one source that start in much the same direction, so that one of them tells of the others
/// (Dmitriev et al. 2002; Larsen 2004, ch. 9).
struct PhotonGroups {
  std::vector<std::uint32_t> photons;  ///< group after group, as many each; the last may have fewer
  std::uint32_t size = 1;

  std::uint32_t count() const { return static_cast<std::uint32_t>((photons.size() + size - 1) / size); }
  std::span<const std::uint32_t> group(std::uint32_t index) const {
    const std::size_t first = std::size_t{index} * size;
    return std::span(photons).subspan(first, std::min<std::size_t>(size, photons.size() - first));
  }
};

/// Cuts a source's photons into groups of `size`, 1 or more, along a Hilbert curve through the square of
/// directions: groups are compact there, whatever the number of photons.
PhotonGroups makePhotonGroups(const device::PhotonSource& source, std::span<const device::SourceCell> cells,
                              std::uint32_t size);

}  // namespace prelight
