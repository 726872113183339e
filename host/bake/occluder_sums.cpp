#include "bake/occluder_sums.h"

#include <algorithm>

namespace prelight {

namespace {

std::array<double, OccluderRightSides::columns> columnsOf(const device::OccluderSums& s) {
  return {s.formFactor, s.direction[0],  s.direction[1], s.direction[2], s.offset[0],
          s.offset[1],  s.offset[2],     s.distance,     s.normal[0],    s.normal[1],
          s.normal[2],  s.accessibility, s.color[0],     s.color[1],     s.color[2]};
}

}  // namespace

void OccluderRightSides::add(const SurfaceSample& sample, double weight, const device::OccluderSums& sums) {
  const auto values = columnsOf(sums);
  const auto corners = cornerWeights(sample);
  for (std::size_t k = 0; k < 3; ++k) {
    std::vector<Entry>& entries = entries_[mesh_.triangles[sample.triangle][k]];
    auto at = std::find_if(entries.begin(), entries.end(),
                           [&](const Entry& entry) { return entry.group == sums.group; });
    if (at == entries.end()) at = entries.insert(at, Entry{sums.group, {}});
    for (std::size_t c = 0; c < columns; ++c) at->sums[c] += weight * corners[k] * values[c];
  }
}

void OccluderRightSides::scatter(std::uint32_t group, std::span<double> rightSide, std::size_t width,
                                 std::size_t first) const {
  for (std::size_t slot = 0; slot < entries_.size(); ++slot)
    for (const Entry& entry : entries_[slot])
      if (entry.group == group)
        for (std::size_t c = 0; c < columns; ++c) rightSide[slot * width + first + c] += entry.sums[c];
}

std::vector<std::uint32_t> OccluderRightSides::groupsNear(std::uint32_t slot) const {
  std::vector<std::uint32_t> groups;
  const auto addOf = [&](std::uint32_t other) {
    for (const Entry& entry : entries_[other]) groups.push_back(entry.group);
  };
  addOf(slot);
  for (std::uint32_t e = mesh_.rowStart[slot]; e < mesh_.rowStart[slot + 1]; ++e) addOf(mesh_.columns[e]);
  std::sort(groups.begin(), groups.end());
  groups.erase(std::unique(groups.begin(), groups.end()), groups.end());
  return groups;
}

}  // namespace prelight
