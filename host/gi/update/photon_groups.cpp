#include "gi/update/photon_groups.h"

#include <algorithm>
#include <numeric>
#include <utility>

#include "receivers/sampling.h"

namespace prelight {

namespace {

constexpr std::uint32_t curveBits = 16;  // per coordinate

/// Returns the index along the Hilbert curve of a cell in a square with 2^curveBits cells per side.
std::uint64_t hilbertPlace(std::uint32_t x, std::uint32_t y) {
  std::uint64_t place = 0;
  for (std::uint32_t s = 1u << (curveBits - 1); s > 0; s /= 2) {
    const std::uint32_t right = (x & s) != 0 ? 1 : 0, up = (y & s) != 0 ? 1 : 0;
    place += std::uint64_t{s} * s * ((3 * right) ^ up);
    if (up != 0) continue;
    if (right != 0) {
      x = s - 1 - (x & (s - 1));
      y = s - 1 - (y & (s - 1));
    }
    std::swap(x, y);
  }
  return place;
}

/// Returns the direction that directionBits() of kernels/photon/emit_kernels.cl chooses for a photon.
glm::dvec2 directionPoint(const device::PhotonSource& source, std::span<const device::SourceCell> cells,
                          std::uint32_t photon) {
  if (source.cellCount == 0) return sampling::sobol(photon, source.seed);
  const std::uint32_t cell = cells[source.firstCell + photon % source.cellCount].cell;
  const glm::dvec2 within =
      sampling::sobol(photon / source.cellCount, source.seed ^ sampling::hashInteger(cell));
  return (glm::dvec2(cell % source.cellsASide, cell / source.cellsASide) + within) /
         double(source.cellsASide);
}

}  // namespace

PhotonGroups makePhotonGroups(const device::PhotonSource& source, std::span<const device::SourceCell> cells,
                              std::uint32_t size) {
  PhotonGroups groups;
  groups.size = size;
  groups.photons.resize(source.count);
  std::iota(groups.photons.begin(), groups.photons.end(), 0u);
  std::vector<std::uint64_t> places;
  places.reserve(source.count);
  for (std::uint32_t i = 0; i < source.count; ++i) {
    const glm::dvec2 u = directionPoint(source, cells, i) * double(1u << curveBits);
    places.push_back(hilbertPlace(static_cast<std::uint32_t>(u.x), static_cast<std::uint32_t>(u.y)));
  }
  std::sort(groups.photons.begin(), groups.photons.end(), [&](std::uint32_t a, std::uint32_t b) {
    return places[a] != places[b] ? places[a] < places[b] : a < b;
  });
  return groups;
}

}  // namespace prelight
