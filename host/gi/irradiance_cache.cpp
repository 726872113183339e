#include "gi/irradiance_cache.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <utility>

#include "base/parallel.h"
#include "gi/final_gather.h"

namespace prelight {

namespace {

/// A record and a place are on different levels if their offset along the mean normal exceeds this share of
/// their distance.
constexpr double mostStep = 0.2;

glm::vec3 vectorOf(const float (&v)[3]) { return {v[0], v[1], v[2]}; }

/// Extrapolates irradiance along the gradients, by at most `most` of the light: the least reach of records
/// may be too far for the gradient beside an edge.
glm::vec3 extrapolate(const CachedIrradiance& record, const glm::vec3& position, const glm::vec3& normal,
                      double most) {
  const glm::vec3 way = position - record.position, turn = glm::cross(record.normal, normal);
  glm::vec3 irradiance;
  for (int c = 0; c < 3; ++c) {
    const float here = record.light.irradiance[c], bound = static_cast<float>(most) * here;
    const float change = glm::dot(way, vectorOf(record.light.translation[c])) +
                         glm::dot(turn, vectorOf(record.light.rotation[c]));
    irradiance[c] = here + std::clamp(change, -bound, bound);
  }
  return irradiance;
}

std::uint64_t cellKey(const std::array<std::int64_t, 3>& cell) {
  constexpr std::uint64_t mask = (1u << 21) - 1;
  std::uint64_t key = 0;
  for (const std::int64_t c : cell) key = key << 21 | (static_cast<std::uint64_t>(c) & mask);
  return key;
}

std::array<std::int64_t, 3> cellOf(const glm::dvec3& position, double side) {
  return {std::llround(std::floor(position.x / side)), std::llround(std::floor(position.y / side)),
          std::llround(std::floor(position.z / side))};
}

}  // namespace

/// Returns the reach of a record. A record beside a wall sees it, so that a reach limited by the distance of
/// visible surfaces does not extend through the wall.
double IrradianceCache::reachOf(const device::GatherRecord& light) const {
  glm::dvec3 gradient(0.0);
  double sum = 0.0;
  for (int c = 0; c < 3; ++c) {
    gradient += glm::dvec3(vectorOf(light.translation[c]));
    sum += light.irradiance[c];
  }
  double radius = light.closeness > 0.0f ? 1.0 / light.closeness : std::numeric_limits<double>::infinity();
  if (glm::length(gradient) > 0.0) radius = std::min(radius, sum / glm::length(gradient));
  return std::min(std::clamp(options_.error * radius, options_.leastReach, options_.mostReach),
                  static_cast<double>(light.nearest));
}

/// Returns the weight of a record: 1 at its place, 0 at its reach.
double IrradianceCache::weight(const Record& record, const glm::vec3& position,
                               const glm::vec3& normal) const {
  const glm::dvec3 way = glm::dvec3(position) - glm::dvec3(record.cached.position);
  const double distance = glm::length(way);
  if (!(distance < record.reach)) return 0.0;
  const glm::dvec3 n(normal), of(record.cached.normal);
  if (std::abs(0.5 * glm::dot(way, n + of)) > mostStep * distance) return 0.0;
  const double turn = std::sqrt(std::max(0.0, 1.0 - glm::dot(n, of)));
  return std::max(0.0, 1.0 - distance / record.reach - turn / options_.error);
}

template <typename Visit>
void IrradianceCache::visitNear(const glm::vec3& position, const Visit& visit) const {
  for (const Level& level : levels_) {
    const auto found = level.cells.find(cellKey(cellOf(glm::dvec3(position), level.cell)));
    if (found == level.cells.end()) continue;
    for (const std::uint32_t i : found->second) visit(i);
  }
}

/// Sorts the records into levels, one per doubling of the reach. A record lies in up to eight cells.
void IrradianceCache::sortIn() {
  levels_.clear();
  for (double cell = 2.0 * options_.leastReach;; cell *= 2.0) {
    levels_.push_back({cell, {}});
    if (cell >= 2.0 * options_.mostReach) break;
  }
  for (std::size_t i = 0; i < records_.size(); ++i) {
    const Record& record = records_[i];
    const auto level = std::find_if(levels_.begin(), levels_.end() - 1,
                                    [&](const Level& l) { return l.cell >= 2.0 * record.reach; });
    const glm::dvec3 centre(record.cached.position), half(record.reach);
    const auto low = cellOf(centre - half, level->cell), high = cellOf(centre + half, level->cell);
    for (std::int64_t x = low[0]; x <= high[0]; ++x)
      for (std::int64_t y = low[1]; y <= high[1]; ++y)
        for (std::int64_t z = low[2]; z <= high[2]; ++z)
          level->cells[cellKey({x, y, z})].push_back(static_cast<std::uint32_t>(i));
  }
}

/// Clamps reaches to those of neighbours, in order of increasing reach, as small reaches clamp larger ones.
void IrradianceCache::clampToNeighbours() {
  std::vector<std::uint32_t> order(records_.size());
  std::iota(order.begin(), order.end(), 0u);
  std::stable_sort(order.begin(), order.end(),
                   [&](std::uint32_t a, std::uint32_t b) { return records_[a].reach < records_[b].reach; });
  for (const std::uint32_t j : order) {
    const Record& near = records_[j];
    visitNear(near.cached.position, [&](std::uint32_t i) {
      Record& record = records_[i];
      if (!(weight(record, near.cached.position, near.cached.normal) > 0.0)) return;
      const double distance = glm::distance(record.cached.position, near.cached.position);
      record.reach = std::min(record.reach, near.reach + options_.error * distance);
    });
  }
}

void IrradianceCache::add(std::span<const CachedIrradiance> records) {
  for (const CachedIrradiance& record : records) records_.push_back({record, reachOf(record.light)});
  sortIn();
  clampToNeighbours();
}

bool IrradianceCache::covers(const glm::vec3& position, const glm::vec3& normal) const {
  bool covered = false;
  visitNear(position,
            [&](std::uint32_t i) { covered = covered || weight(records_[i], position, normal) > 0.0; });
  return covered;
}

std::optional<glm::vec3> IrradianceCache::at(const glm::vec3& position, const glm::vec3& normal) const {
  glm::dvec3 sum(0.0);
  double weights = 0.0;
  visitNear(position, [&](std::uint32_t i) {
    const double w = weight(records_[i], position, normal);
    if (!(w > 0.0)) return;
    sum += w * glm::dvec3(extrapolate(records_[i].cached, position, normal, options_.error));
    weights += w;
  });
  if (!(weights > 0.0)) return std::nullopt;
  return glm::vec3(sum / weights);
}

RecordGather::RecordGather(const FinalGather& gather) {
  DeviceContext& device = gather.device();
  distances_ = Buffer<float>(device, std::size_t{gather.receiversAtOnce()} * gather.raysPerReceiver());
  recordBuffer_ = Buffer<device::GatherRecord>(device, gather.receiversAtOnce());
  const char* file = "gather/record_kernels.cl";
  generate_ = {device, file, {}, "generateRecordRays"};
  store_ = {device, file, {}, "storeDistances"};
  sum_ = {device, file, {}, "sumRecords"};
}

void RecordGather::makeRays(const GatherBlock& block) {
  generate_.launch(block.rayCount, block.parameters, block.receivers, block.rays);
}

void RecordGather::meet(const GatherBlock& block) {
  store_.launch(block.rayCount, static_cast<std::uint32_t>(block.rayCount), block.hits, distances_);
}

void RecordGather::sum(const GatherBlock& block) {
  sum_.launch(block.count, block.parameters, block.receivers, block.radiances, distances_, recordBuffer_);
  const std::size_t before = records_.size();
  records_.resize(before + block.count);
  recordBuffer_.read(std::span(&records_[before], block.count));
}

namespace {

constexpr std::uint32_t coarsest = 16;   // texels between the first records
constexpr std::size_t texelGrain = 512;  // texels

void addTo(device::GatherRecord& sum, const device::GatherRecord& part, float share) {
  sum.closeness += share * part.closeness;
  sum.nearest = std::min(sum.nearest, part.nearest);
  for (int c = 0; c < 3; ++c) {
    sum.irradiance[c] += share * part.irradiance[c];
    for (int k = 0; k < 3; ++k) {
      sum.translation[c][k] += share * part.translation[c][k];
      sum.rotation[c][k] += share * part.rotation[c][k];
    }
  }
}

class CachedGather {
 public:
  CachedGather(FinalGather& gather, const CompiledScene& compiled, std::span<const LightMapTexel> places,
               const CachedGatherRequest& request)
      : gather_(gather),
        compiled_(compiled),
        request_(request),
        places_(places),
        receivers_(gatherReceivers(compiled, places, 1, 0, request.seed)),
        pattern_(gather),
        cache_(request.cache),
        recorded_(places.size(), 0),
        values_(places.size(), glm::vec3(0.0f)) {}

  /// Gathers at those of every `stride`-th texel in both directions that the cache does not cover. Returns
  /// their number.
  std::size_t refine(std::uint32_t stride, Progress& progress) {
    const std::vector<std::uint32_t> chosen = uncovered(stride);
    if (chosen.empty()) return 0;
    std::vector<LightMapTexel> places;
    for (const std::uint32_t i : chosen) places.push_back(places_[i]);
    const std::uint32_t count = std::max(1u, request_.rays / gather_.raysPerReceiver());
    const auto rays = gather_.raysPerReceiver();
    gather_.gather(gatherReceivers(compiled_, places, count, rays, request_.seed), pattern_, progress);
    const std::vector<device::GatherRecord> found = pattern_.take();
    std::vector<CachedIrradiance> records(chosen.size());
    for (std::size_t k = 0; k < chosen.size(); ++k) {
      records[k].light.nearest = found[k * count].nearest;
      for (std::size_t part = 0; part < count; ++part)
        addTo(records[k].light, found[k * count + part], 1.0f / static_cast<float>(count));
      records[k].position = position(chosen[k]);
      records[k].normal = normal(chosen[k]);
      recorded_[chosen[k]] = 1;
      const float* e = records[k].light.irradiance;
      values_[chosen[k]] = {e[0], e[1], e[2]};
    }
    cache_.add(records);
    return chosen.size();
  }

  /// Interpolates at all places. Places that no record reaches are records themselves, close to another
  /// surface.
  std::vector<glm::vec3> interpolate() {
    parallelRanges(places_.size(), texelGrain, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i)
        if (const auto found = cache_.at(position(i), normal(i))) values_[i] = *found;
    });
    return std::move(values_);
  }

 private:
  glm::vec3 position(std::size_t place) const {
    const float* p = receivers_[place].position;
    return {p[0], p[1], p[2]};
  }
  glm::vec3 normal(std::size_t place) const {
    const float* n = receivers_[place].normal;
    return {n[0], n[1], n[2]};
  }

  std::vector<std::uint32_t> uncovered(std::uint32_t stride) const {
    std::vector<std::uint8_t> wanted(places_.size(), 0);
    parallelRanges(places_.size(), texelGrain, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) {
        const std::uint32_t x = places_[i].texel % request_.width, y = places_[i].texel / request_.width;
        if (recorded_[i] != 0 || x % stride != 0 || y % stride != 0) continue;
        wanted[i] = cache_.covers(position(i), normal(i)) ? 0 : 1;
      }
    });
    std::vector<std::uint32_t> chosen;
    for (std::uint32_t i = 0; i < wanted.size(); ++i)
      if (wanted[i] != 0) chosen.push_back(i);
    return chosen;
  }

  FinalGather& gather_;
  const CompiledScene& compiled_;
  const CachedGatherRequest& request_;
  std::span<const LightMapTexel> places_;
  std::vector<device::Receiver> receivers_;
  RecordGather pattern_;
  IrradianceCache cache_;
  std::vector<std::uint8_t> recorded_;  ///< [place]
  std::vector<glm::vec3> values_;       ///< [place] W/m2
};

}  // namespace

std::vector<glm::vec3> gatherCached(FinalGather& gather, const CompiledScene& compiled,
                                    std::span<const LightMapTexel> places, const CachedGatherRequest& request,
                                    Progress& progress, std::size_t& records) {
  CachedGather cached(gather, compiled, places, request);
  records = 0;
  for (std::uint32_t stride = coarsest; stride > 1; stride /= 2) records += cached.refine(stride, progress);
  // New records clamp their neighbours, which may uncover a texel again. Each texel becomes a record at most
  // once.
  while (const std::size_t more = cached.refine(1, progress)) records += more;
  return cached.interpolate();
}

}  // namespace prelight
