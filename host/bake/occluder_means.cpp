#include "bake/occluder_means.h"

#include <algorithm>

namespace prelight {

namespace {

constexpr int mostRings = 8;  // around a slot without receivers

glm::vec3 vec(const float* v) { return {v[0], v[1], v[2]}; }

SeenOccluder seenBy(const device::Receiver& receiver, const OccluderValues& values, std::size_t record) {
  const device::OccluderSums& sums = values.sums[record];
  SeenOccluder seen;
  seen.formFactor = sums.formFactor;
  seen.direction = vec(sums.direction);
  seen.offset = vec(sums.offset);
  seen.position = seen.offset + sums.formFactor * vec(receiver.position);
  seen.distance = sums.distance;
  seen.normal = vec(sums.normal);
  seen.accessibility = sums.accessibility;
  seen.color = vec(sums.color);
  if (!values.mirrored.empty()) {
    const device::OccluderWaySums& ways = values.mirrored[record];
    seen.mirrorNormal = vec(ways.vector);
    seen.mirrorFactor = ways.formFactor;
    seen.mirrorColor = vec(ways.color);
  }
  if (!values.through.empty()) {
    const device::OccluderWaySums& ways = values.through[record];
    seen.throughDirection = vec(ways.vector);
    seen.throughFactor = ways.formFactor;
    seen.throughColor = vec(ways.color);
  }
  return seen;
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
  mirrorNormal += other.mirrorNormal;
  mirrorFactor += other.mirrorFactor;
  mirrorColor += other.mirrorColor;
  throughDirection += other.throughDirection;
  throughFactor += other.throughFactor;
  throughColor += other.throughColor;
  return *this;
}

SeenOccluder SeenOccluder::operator*(float factor) const {
  return {factor * formFactor,    factor * direction,    factor * position,      factor * offset,
          factor * distance,      factor * normal,       factor * accessibility, factor * color,
          factor * mirrorNormal,  factor * mirrorFactor, factor * mirrorColor,   factor * throughDirection,
          factor * throughFactor, factor * throughColor};
}

void OccluderMeans::Row::add(std::uint32_t group, const SeenOccluder& part) {
  const auto at = static_cast<std::size_t>(std::find(groups.begin(), groups.end(), group) - groups.begin());
  if (at < groups.size()) {
    seen[at] += part;
    return;
  }
  groups.push_back(group);
  seen.push_back(part);
}

void OccluderMeans::add(const SurfaceSample& sample, const device::Receiver& receiver,
                        const OccluderValues& values, std::size_t index) {
  const auto corners = cornerWeights(sample);
  std::array<Row*, 3> rows;
  std::array<float, 3> weights;
  for (std::size_t k = 0; k < 3; ++k) {
    rows[k] = &rows_[mesh_.triangles[sample.triangle][k]];
    weights[k] = sample.weight * static_cast<float>(corners[k]);
    rows[k]->weight += weights[k];
  }
  const OccluderValues::Span& span = values.spans[index];
  for (std::size_t r = span.first; r < std::size_t{span.first} + span.count; ++r) {
    const SeenOccluder seen = seenBy(receiver, values, r);
    for (std::size_t k = 0; k < 3; ++k) rows[k]->add(values.sums[r].group, seen * weights[k]);
  }
}

std::vector<OccluderSeen> OccluderMeans::around(std::uint32_t slot) const {
  std::vector<std::uint32_t> slots = {slot};
  for (int ring = 0; ring < mostRings && rows_[slot].groups.empty(); ++ring) {
    const std::vector<std::uint32_t> inner = slots;
    for (const std::uint32_t s : inner)
      slots.insert(slots.end(), mesh_.columns.begin() + mesh_.rowStart[s],
                   mesh_.columns.begin() + mesh_.rowStart[s + 1]);
    std::sort(slots.begin(), slots.end());
    slots.erase(std::unique(slots.begin(), slots.end()), slots.end());
    if (std::any_of(slots.begin(), slots.end(), [&](std::uint32_t s) { return !rows_[s].groups.empty(); }))
      break;
  }
  Row mean;
  for (const std::uint32_t s : slots) {
    mean.weight += rows_[s].weight;
    for (std::size_t i = 0; i < rows_[s].groups.size(); ++i) mean.add(rows_[s].groups[i], rows_[s].seen[i]);
  }
  std::vector<OccluderSeen> seen;
  for (std::size_t i = 0; i < mean.groups.size(); ++i)
    seen.push_back({mean.groups[i], mean.seen[i] * (1.0f / mean.weight)});
  std::sort(seen.begin(), seen.end(), [](const auto& a, const auto& b) { return a.group < b.group; });
  return seen;
}

void OccluderMeans::save(StateWriter& state) const {
  for (const Row& row : rows_) {
    state.value(row.weight);
    state.values(row.groups);
    state.values(row.seen);
  }
}

void OccluderMeans::load(StateReader& state) {
  for (Row& row : rows_) {
    state.value(row.weight);
    state.values(row.groups);
    state.values(row.seen);
    if (row.groups.size() != row.seen.size()) state.damaged();
  }
}

}  // namespace prelight
