#include "techniques/vector_occluders/occluder_means.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

namespace prelight {

namespace {

constexpr int mostRings = 8;  // around a slot without receivers

glm::vec3 vec(const float* v) { return {v[0], v[1], v[2]}; }

SeenOccluder seenBy(const device::Receiver& receiver, const device::OccluderSums& sums) {
  SeenOccluder seen;
  seen.formFactor = sums.formFactor;
  seen.direction = vec(sums.direction);
  seen.offset = vec(sums.offset);
  seen.position = seen.offset + sums.formFactor * vec(receiver.position);
  seen.distance = sums.distance;
  seen.normal = vec(sums.normal);
  seen.accessibility = sums.accessibility;
  seen.color = vec(sums.color);
  return seen;
}

}  // namespace

void SeenOccluder::add(const SeenOccluder& other, float factor) {
  formFactor += factor * other.formFactor;
  direction += factor * other.direction;
  position += factor * other.position;
  offset += factor * other.offset;
  distance += factor * other.distance;
  normal += factor * other.normal;
  accessibility += factor * other.accessibility;
  color += factor * other.color;
}

void SeenWays::add(const SeenWays& other, float factor) {
  mirrorNormal += factor * other.mirrorNormal;
  mirrorFactor += factor * other.mirrorFactor;
  mirrorColor += factor * other.mirrorColor;
  throughDirection += factor * other.throughDirection;
  throughFactor += factor * other.throughFactor;
  throughColor += factor * other.throughColor;
}

/// The place of an occluder, which gets one where it has none.
std::size_t OccluderMeans::Row::placeOf(std::uint32_t group) {
  const auto at = static_cast<std::size_t>(std::find(groups.begin(), groups.end(), group) - groups.begin());
  if (at == groups.size()) {
    groups.push_back(group);
    seen.emplace_back();
  }
  return at;
}

void OccluderMeans::add(const SeenBlock& block) {
  for (std::size_t i = 0; i < block.samples.size(); ++i) addReceiver(block, i);
}

/// `sums`: of a record, [PRELIGHT_WAYS].
SeenWays OccluderMeans::waysOf(const device::OccluderWaySums* sums) const {
  SeenWays seen;
  if (column_.hasMirrors()) {
    const device::OccluderWaySums& ways = sums[PRELIGHT_WAY_MIRRORED];
    seen.mirrorNormal = vec(ways.vector);
    seen.mirrorFactor = ways.formFactor;
    seen.mirrorColor = vec(ways.color);
  }
  if (column_.hasGlass()) {
    const device::OccluderWaySums& ways = sums[PRELIGHT_WAY_THROUGH];
    seen.throughDirection = vec(ways.vector);
    seen.throughFactor = ways.formFactor;
    seen.throughColor = vec(ways.color);
  }
  return seen;
}

void OccluderMeans::addReceiver(const SeenBlock& block, std::size_t index) {
  const SurfaceSample& sample = block.samples[index];
  const ColumnRows& seenRows = block.rows.of(column_);
  const auto records = seenRows.recordsOf<device::OccluderSums>(OccluderColumn::sums);
  const bool withWays = column_.hasMirrors() || column_.hasGlass();
  const auto corners = cornerWeights(sample);
  std::array<Row*, 3> rows{};
  std::array<float, 3> weights{};
  for (std::size_t k = 0; k < 3; ++k) {
    rows[k] = &rows_[mesh_.triangles[sample.triangle][k]];
    weights[k] = sample.weight * static_cast<float>(corners[k]);
    rows[k]->weight += weights[k];
  }
  const RecordSpan& span = seenRows.of<RecordSpan>()[index];
  for (std::size_t r = span.first; r < std::size_t{span.first} + span.count; ++r) {
    const SeenOccluder seen = seenBy(block.receivers[index], records[r]);
    SeenWays ways;
    if (withWays)
      ways = waysOf(&seenRows.recordsOf<device::OccluderWaySums>(OccluderColumn::ways)[PRELIGHT_WAYS * r]);
    for (std::size_t k = 0; k < 3; ++k) {
      Row& row = *rows[k];
      const std::size_t place = row.placeOf(records[r].group);
      row.seen[place].add(seen, weights[k]);
      if (!withWays) continue;
      row.ways.resize(row.groups.size());
      row.ways[place].add(ways, weights[k]);
    }
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
  float weight = 0.0f;
  for (const std::uint32_t s : slots) weight += rows_[s].weight;
  Row mean;
  for (const std::uint32_t s : slots)
    for (std::size_t i = 0; i < rows_[s].groups.size(); ++i) {
      const std::size_t place = mean.placeOf(rows_[s].groups[i]);
      mean.seen[place].add(rows_[s].seen[i], 1.0f / weight);
      mean.ways.resize(mean.groups.size());
      if (!rows_[s].ways.empty()) mean.ways[place].add(rows_[s].ways[i], 1.0f / weight);
    }
  std::vector<OccluderSeen> seen;
  for (std::size_t i = 0; i < mean.groups.size(); ++i)
    seen.push_back({mean.groups[i], mean.seen[i], mean.ways[i]});
  std::sort(seen.begin(), seen.end(), [](const auto& a, const auto& b) { return a.group < b.group; });
  return seen;
}

void OccluderMeans::save(StateWriter& state) const {
  for (const Row& row : rows_) {
    state.value(row.weight);
    state.values(row.groups);
    state.values(row.seen);
    state.values(row.ways);
  }
}

void OccluderMeans::load(StateReader& state, const SeenCounts& /*counts*/) {
  const std::size_t occluders = column_.groups().names.size();
  for (Row& row : rows_) {
    state.value(row.weight);
    state.values(row.groups);
    state.values(row.seen);
    state.values(row.ways);
    state.require(row.groups.size() == row.seen.size());
    state.require(row.ways.empty() || row.ways.size() == row.seen.size());
    state.require(std::isfinite(row.weight) && (row.groups.empty() || row.weight > 0.0f));
    for (const std::uint32_t group : row.groups) state.require(group < occluders);
    state.requireFinite(numbersOf(row.seen));
    state.requireFinite(numbersOf(row.ways));
  }
}

}  // namespace prelight
