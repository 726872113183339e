#include "bake/occluder_sums.h"

#include <algorithm>

namespace prelight {

namespace {

constexpr int mostRings = 8;  // around a slot without receivers

glm::dvec3 vec(const float* v) { return {v[0], v[1], v[2]}; }

void addTo(std::vector<SeenOccluder>& entries, const SeenOccluder& seen) {
  const auto at = std::find_if(entries.begin(), entries.end(),
                               [&](const SeenOccluder& entry) { return entry.group == seen.group; });
  if (at == entries.end())
    entries.push_back(seen);
  else
    *at += seen;
}

}  // namespace

SeenOccluder& SeenOccluder::operator+=(const SeenOccluder& other) {
  formFactor += other.formFactor;
  direction += other.direction;
  position += other.position;
  offset += other.offset;
  distance += other.distance;
  normal += other.normal;
  accessibility += other.accessibility;
  color += other.color;
  return *this;
}

SeenOccluder& SeenOccluder::operator*=(double factor) {
  formFactor *= factor;
  direction *= factor;
  position *= factor;
  offset *= factor;
  distance *= factor;
  normal *= factor;
  accessibility *= factor;
  color *= factor;
  return *this;
}

void OccluderMeans::addReceiver(const SurfaceSample& sample, double weight) {
  const auto corners = cornerWeights(sample);
  for (std::size_t k = 0; k < 3; ++k) weights_[mesh_.triangles[sample.triangle][k]] += weight * corners[k];
}

void OccluderMeans::add(const SurfaceSample& sample, double weight, const device::Receiver& receiver,
                        const device::OccluderSums& sums) {
  const SeenOccluder seen{
      sums.group,          sums.formFactor,
      vec(sums.direction), vec(sums.offset) + double(sums.formFactor) * vec(receiver.position),
      vec(sums.offset),    sums.distance,
      vec(sums.normal),    sums.accessibility,
      vec(sums.color)};
  const auto corners = cornerWeights(sample);
  for (std::size_t k = 0; k < 3; ++k) {
    SeenOccluder part = seen;
    part *= weight * corners[k];
    addTo(entries_[mesh_.triangles[sample.triangle][k]], part);
  }
}

std::vector<SeenOccluder> OccluderMeans::meanOver(const std::vector<std::uint32_t>& slots) const {
  std::vector<SeenOccluder> mean;
  double weight = 0.0;
  for (const std::uint32_t slot : slots) {
    weight += weights_[slot];
    for (const SeenOccluder& seen : entries_[slot]) addTo(mean, seen);
  }
  for (SeenOccluder& seen : mean) seen *= 1.0 / weight;
  std::sort(mean.begin(), mean.end(), [](const auto& a, const auto& b) { return a.group < b.group; });
  return mean;
}

std::vector<SeenOccluder> OccluderMeans::around(std::uint32_t slot) const {
  std::vector<std::uint32_t> slots = {slot};
  for (int ring = 0; ring < mostRings && entries_[slot].empty(); ++ring) {
    const std::vector<std::uint32_t> inner = slots;
    for (const std::uint32_t s : inner)
      slots.insert(slots.end(), mesh_.columns.begin() + mesh_.rowStart[s],
                   mesh_.columns.begin() + mesh_.rowStart[s + 1]);
    std::sort(slots.begin(), slots.end());
    slots.erase(std::unique(slots.begin(), slots.end()), slots.end());
    if (std::any_of(slots.begin(), slots.end(), [&](std::uint32_t s) { return !entries_[s].empty(); })) break;
  }
  return meanOver(slots);
}

}  // namespace prelight
