#include "gi/cached_gather.h"

#include <algorithm>
#include <utility>

#include "base/parallel.h"
#include "gi/gather_receivers.h"
#include "gi/record_gather.h"

namespace prelight {

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
