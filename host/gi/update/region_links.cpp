#include "gi/update/region_links.h"

#include <algorithm>
#include <limits>

namespace prelight {

RegionLinks::RegionLinks(const SurfaceRegions& regions, std::vector<std::uint8_t> relays)
    : regionOf_(regions.regionOf),
      areas_(regions.areas),
      relays_(std::move(relays)),
      most_(regions.count(), std::numeric_limits<double>::infinity()),
      rays_(regions.count(), 0.0),
      hits_(regions.count()),
      neighbours_(regions.count()) {}

void RegionLinks::add(std::uint32_t region, std::span<const std::uint32_t> triangles) {
  if (rays_[region] > most_[region]) {
    rays_[region] *= 0.5;
    for (auto& [seen, hits] : hits_[region]) hits *= 0.5;
  }
  rays_[region] += static_cast<double>(triangles.size());
  for (const std::uint32_t t : triangles) {
    if (t >= regionOf_.size()) continue;
    const std::uint32_t seen = regionOf_[t];
    const auto [entry, fresh] = hits_[region].try_emplace(seen, 0.0);
    entry->second += 1.0;
    if (!fresh) continue;
    for (const auto& [a, b] : {std::pair(region, seen), std::pair(seen, region)})
      if (std::find(neighbours_[a].begin(), neighbours_[a].end(), b) == neighbours_[a].end())
        neighbours_[a].push_back(b);
  }
}

void RegionLinks::endPass() {
  for (std::size_t r = 0; r < rays_.size(); ++r) most_[r] = 2.0 * rays_[r];
}

/// Returns the form factor from a region's own rays or, by reciprocity, from those of the other region.
double RegionLinks::formFactor(std::uint32_t from, std::uint32_t to) const {
  const auto share = [this](std::uint32_t a, std::uint32_t b) {
    const auto found = hits_[a].find(b);
    return found == hits_[a].end() ? 0.0 : found->second / rays_[a];
  };
  const double turned = areas_[from] > 0.0 ? share(to, from) * areas_[to] / areas_[from] : 0.0;
  return std::max(share(from, to), std::min(turned, 1.0));
}

void RegionLinks::spread(std::span<const RegionChange> changes, double least,
                         std::span<double> expected) const {
  for (const RegionChange& change : changes)
    if (change.irradiance > 0.0) spreadFrom(change, least, expected);
}

/// Spreads a change. `least` is the smallest change that relays pass on; none: they pass on nothing.
void RegionLinks::spreadFrom(const RegionChange& change, std::optional<double> least,
                             std::span<double> expected) const {
  for (const std::uint32_t r : neighbours_[change.region]) {
    const double arrives = formFactor(r, change.region) * change.irradiance;
    expected[r] += arrives;
    if (least && arrives >= *least && relays_[r] != 0) spreadFrom({r, arrives}, std::nullopt, expected);
  }
}

}  // namespace prelight
