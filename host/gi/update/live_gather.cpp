#include "gi/update/live_gather.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

#include "base/colour.h"
#include "gi/indirect_light.h"
#include "gi/update/coarse_light.h"
#include "receivers/surface_sampler.h"
#include "scene/lobes.h"

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

namespace {

/// Rays by which moved mirrors and the like find what sees them.
constexpr std::size_t raysOfLooks = 8192;

/// Mirrors do not pass on changes below this share of the least change for which a texel is gathered again.
constexpr double relayedShare = 0.1;

GatherRequest requestOf(const LiveGatherOptions& options) {
  return gatherRequest({.rays = options.rays, .seed = options.seed});
}

glm::dvec3 pointOf(const CompiledScene& scene, const LightMapTexel& place) {
  const glm::uvec3 t = scene.triangles[triangleOf(scene, place)];
  return (1.0 - double(place.b1) - double(place.b2)) * glm::dvec3(scene.positions[t.x]) +
         double(place.b1) * glm::dvec3(scene.positions[t.y]) +
         double(place.b2) * glm::dvec3(scene.positions[t.z]);
}

/// Returns 1 for each region without a texel, [region].
std::vector<std::uint8_t> regionsWithoutTexels(const CompiledScene& scene, const LightMapLayout& layout,
                                               const SurfaceRegions& regions) {
  std::vector<std::uint8_t> without(regions.count(), 1);
  for (const LightMapTexel& place : layout.texels) without[regions.regionOf[triangleOf(scene, place)]] = 0;
  return without;
}

/// Returns the regions that reflect other surfaces: those without texels and those with a specular or glossy
/// lobe.
std::vector<std::uint8_t> reflectingRegions(const CompiledScene& scene, const SurfaceRegions& regions,
                                            std::vector<std::uint8_t> reflecting) {
  for (std::uint32_t t = 0; t < scene.triangleCount(); ++t) {
    const CompiledMaterial& material = scene.materials[scene.triangleMaterials[t]];
    if (isGlass(material) || reflectsSpecularly(material)) reflecting[regions.regionOf[t]] = 1;
  }
  return reflecting;
}

/// Texels that face away from the eye count this much of those that face it.
constexpr double awayWeight = 0.1;

/// Returns how much the light of a place matters to an eye: less with the square of the distance from
/// `near` on.
double weightFor(const CompiledScene& scene, const LightMapTexel& place, const glm::dvec3& eye, double near) {
  const glm::dvec3 way = eye - pointOf(scene, place);
  const std::uint32_t triangle = triangleOf(scene, place);
  const double side = triangle == place.face ? 1.0 : -1.0;
  const bool faces = side * glm::dot(glm::dvec3(geometricNormal(scene, triangle)), way) > 0.0;
  return (faces ? 1.0 : awayWeight) / (1.0 + glm::dot(way, way) / (near * near));
}

/// Returns the form factor of the bounding ball of a box from a point that faces it, an upper bound for what
/// is in the box.
double ballShare(const Box& box, const glm::dvec3& point) {
  const glm::dvec3 centre = 0.5 * (glm::dvec3(box.lower) + glm::dvec3(box.upper));
  const glm::dvec3 half = 0.5 * (glm::dvec3(box.upper) - glm::dvec3(box.lower));
  const double radius2 = glm::dot(half, half), distance2 = glm::dot(point - centre, point - centre);
  return distance2 > radius2 ? radius2 / distance2 : 1.0;
}

}  // namespace

LiveGather::LiveGather(const CompiledScene& scene, TransportScene& transport, const LightMapLayout& layout,
                       const SurfaceRegions& regions, const IrradianceMap& approximation,
                       const LiveGatherOptions& options)
    : scene_(scene),
      options_(options),
      rays_(requestOf(options).raysPerReceiver),
      receivers_(std::max(1u, options.rays / rays_)),
      gather_(transport, approximation, requestOf(options)),
      places_(layout.texels),
      triangleRegions_(regions.regionOf),
      bare_(regionsWithoutTexels(scene, layout, regions)),
      links_(regions, reflectingRegions(scene, regions, bare_)),
      expected_(regions.count(), 0.0),
      seenExpected_(places_.size(), 0.0),
      near_(places_.size(), 0.0),
      first_(places_.size(), 0),
      boxes_(regions.count()),
      weights_(places_.size(), 1.0),
      gathered_(places_.size(), glm::vec3(0.0f)),
      shown_(places_.size(), glm::vec3(0.0f)),
      coarse_(places_.size(), glm::vec3(0.0f)),
      coarseThen_(places_.size(), glm::vec3(0.0f)),
      offset_(places_.size(), glm::vec3(0.0f)),
      blendLeft_(places_.size(), 0) {
  for (const LightMapTexel& place : places_) regionOf_.push_back(regions.regionOf[triangleOf(scene, place)]);
  for (std::uint32_t t = 0; t < scene.triangleCount(); ++t) growBy(t);
}

double LiveGather::meanIrradiance() const {
  double sum = 0.0;
  for (const glm::vec3& e : gathered_) sum += luminance(glm::dvec3(e));
  return sum / static_cast<double>(std::max<std::size_t>(1, gathered_.size()));
}

void LiveGather::moved(std::span<const std::uint32_t> triangles, double irradiance, Progress& progress) {
  movedIrradiance_ = irradiance;
  std::vector<std::uint8_t> regions(expected_.size(), 0);
  for (const std::uint32_t t : triangles) regions[triangleRegions_[t]] = 1;
  std::vector<Box> boxes;  // old and new bounds of the regions
  for (std::uint32_t r = 0; r < regions.size(); ++r) {
    if (regions[r] == 0) continue;
    boxes.push_back(boxes_[r]);
    boxes_[r] = Box();
    if (std::find(movedRegions_.begin(), movedRegions_.end(), r) == movedRegions_.end())
      movedRegions_.push_back(r);
  }
  for (const std::uint32_t t : triangles) growBy(t);
  for (std::uint32_t r = 0; r < regions.size(); ++r)
    if (regions[r] != 0) boxes.push_back(boxes_[r]);
  const double mean = meanIrradiance();
  for (std::size_t i = 0; i < places_.size(); ++i) {
    if (regions[regionOf_[i]] != 0) {
      first_[i] = 1;
      continue;
    }
    const glm::dvec3 point = pointOf(scene_, places_[i]);
    double share = 0.0;
    for (const Box& box : boxes) share += ballShare(box, point);
    // Places that an object uncovers were dark: their own light tells nothing.
    near_[i] += std::min(share, 1.0) * std::max(mean, luminance(glm::dvec3(gathered_[i])));
  }
  lookAround(triangles, progress);
  announceMoved();
}

/// Extends the bounds of a triangle's region to the triangle's present place.
void LiveGather::growBy(std::uint32_t triangle) {
  for (int k = 0; k < 3; ++k)
    boxes_[triangleRegions_[triangle]].grow(scene_.positions[scene_.triangles[triangle][k]]);
}

/// Mirrors and glass have no texels whose rays would tell what sees them, so rays are cast from a few places
/// on them.
void LiveGather::lookAround(std::span<const std::uint32_t> triangles, Progress& progress) {
  std::vector<std::uint32_t> relays;
  for (const std::uint32_t t : triangles)
    if (bare_[triangleRegions_[t]] != 0) relays.push_back(t);
  std::vector<LightMapTexel> looks;
  const std::size_t count = std::min(std::max<std::size_t>(1, raysOfLooks / rays_), relays.size());
  for (std::size_t i = 0; i < count; ++i)
    looks.push_back(
        {static_cast<std::uint32_t>(i), relays[i * relays.size() / count], 1.0f / 3.0f, 1.0f / 3.0f});
  if (looks.empty()) return;
  std::vector<std::uint32_t> seen;
  gather_.gather(gatherReceivers(scene_, looks, 1, rays_, options_.seed), progress, &seen);
  for (std::size_t i = 0; i < count; ++i)
    links_.add(triangleRegions_[looks[i].face], std::span(seen).subspan(i * rays_, rays_));
}

/// Reports the change due to moved objects: each may hide and reveal as much light as the scene's mean,
/// including lights that glossy surfaces show.
void LiveGather::announceMoved() {
  std::vector<RegionChange> changes;
  for (const std::uint32_t r : movedRegions_) changes.push_back({r, movedIrradiance_});
  approximationChanged(changes);
}

void LiveGather::approximationChanged(std::span<const RegionChange> changes) {
  links_.spread(changes, relayedShare * options_.leastChange * meanIrradiance(), expected_);
}

/// Returns the expected change at a texel, W/m2. It is 0 if the texel's region sees no changed surface.
double LiveGather::expectedChange(std::size_t place) const {
  if (first_[place] != 0) return std::numeric_limits<double>::infinity();
  const double base = expected_[regionOf_[place]] - seenExpected_[place];
  return base > 0.0 ? base + near_[place] : 0.0;
}

/// Returns the change of the coarse light since the texel was gathered, luminance, W/m2.
double LiveGather::coarseChange(std::size_t place) const {
  return luminance(glm::abs(glm::dvec3(coarse_[place]) - glm::dvec3(coarseThen_[place])));
}

/// Returns by what waiting texels are ordered: the change of the coarse light, or, in its absence, the
/// expected change.
double LiveGather::urgency(std::size_t place) const {
  const double expected = expectedChange(place), coarse = coarseChange(place);
  if (std::isinf(expected)) return expected;
  return weights_[place] * (coarse > 0.0 ? coarse : expected);
}

/// Returns whether a texel has changed so much that it is gathered again; `mean` is meanIrradiance().
bool LiveGather::waits(std::size_t place, double mean) const {
  return std::max(expectedChange(place), coarseChange(place)) >
         options_.leastChange * (luminance(glm::dvec3(gathered_[place])) + 0.01 * mean);
}

void LiveGather::look(const glm::dvec3& eye) {
  const double near = 0.25 * glm::length(glm::dvec3(scene_.boundsMax) - glm::dvec3(scene_.boundsMin));
  for (std::size_t i = 0; i < places_.size(); ++i) weights_[i] = weightFor(scene_, places_[i], eye, near);
}

std::vector<double> LiveGather::expectedChanges() const {
  const double mean = meanIrradiance();
  std::vector<double> changes;
  for (std::size_t i = 0; i < places_.size(); ++i) changes.push_back(waits(i, mean) ? urgency(i) : 0.0);
  return changes;
}

/// Returns the texels to gather next, greatest change first, and counts those that wait.
std::vector<std::uint32_t> LiveGather::choose(std::uint32_t texels, std::size_t& waitingCount) const {
  const double mean = meanIrradiance();
  std::vector<std::pair<double, std::uint32_t>> waiting;
  for (std::uint32_t i = 0; i < places_.size(); ++i)
    if (waits(i, mean)) waiting.emplace_back(-urgency(i), i);
  waitingCount = waiting.size();
  const auto end =
      waiting.begin() + static_cast<std::ptrdiff_t>(std::min<std::size_t>(texels, waiting.size()));
  std::partial_sort(waiting.begin(), end, waiting.end());
  std::vector<std::uint32_t> places;
  for (auto entry = waiting.begin(); entry != end; ++entry) places.push_back(entry->second);
  return places;
}

void LiveGather::gather(std::span<const std::uint32_t> places, Progress& progress) {
  std::vector<LightMapTexel> texels;
  for (const std::uint32_t place : places) texels.push_back(places_[place]);
  std::vector<std::uint32_t> seen;
  const std::vector<glm::vec3> found =
      gather_.gather(gatherReceivers(scene_, texels, receivers_, rays_, options_.seed), progress, &seen);
  const std::size_t raysOfTexel = std::size_t{rays_} * receivers_;
  for (std::size_t i = 0; i < places.size(); ++i) {
    glm::dvec3 sum(0.0);
    for (std::size_t k = 0; k < receivers_; ++k) sum += glm::dvec3(found[i * receivers_ + k]);
    const std::uint32_t place = places[i];
    gathered_[place] = glm::vec3(sum / double(receivers_));
    coarseThen_[place] = coarse_[place];
    offset_[place] = shown_[place] - gathered_[place];
    links_.add(regionOf_[place], std::span(seen).subspan(i * raysOfTexel, raysOfTexel));
    seenExpected_[place] = expected_[regionOf_[place]];
    near_[place] = 0.0;
    first_[place] = 0;
    blendLeft_[place] = options_.blendFrames;
  }
}

void LiveGather::gatherAll(Progress& progress) {
  std::vector<std::uint32_t> all(places_.size());
  std::iota(all.begin(), all.end(), 0u);
  gather(all, progress);
  shown_ = gathered_;
  links_.endPass();
  countedRays_ = gather_.rays();
  std::fill(blendLeft_.begin(), blendLeft_.end(), 0u);
  movedRegions_.clear();
}

/// Returns what is shown of a texel now.
glm::vec3 LiveGather::target(std::size_t place) const {
  const glm::vec3 light = followed(gathered_[place], coarseThen_[place], coarse_[place]);
  if (blendLeft_[place] == 0) return light;
  const float rest = static_cast<float>(blendLeft_[place]) / static_cast<float>(options_.blendFrames);
  return glm::max(light + rest * offset_[place], glm::vec3(0.0f));
}

void LiveGather::coarseChanged(std::span<const glm::vec3> light) {
  coarse_.assign(light.begin(), light.end());
  for (std::size_t i = 0; i < places_.size(); ++i) shown_[i] = target(i);
}

void LiveGather::blend(GatherFrame& frame) {
  for (std::size_t i = 0; i < places_.size(); ++i) {
    if (blendLeft_[i] == 0) continue;
    --blendLeft_[i];
    shown_[i] = target(i);
    ++frame.blending;
  }
}

GatherFrame LiveGather::advance(std::uint32_t texels, Progress& progress) {
  GatherFrame frame;
  std::size_t waiting = 0;
  const std::vector<std::uint32_t> places = choose(texels, waiting);
  if (!places.empty()) gather(places, progress);
  if (!movedRegions_.empty() && std::find(first_.begin(), first_.end(), 1) == first_.end()) {
    announceMoved();  // now that their texels have told who sees them
    movedRegions_.clear();
  }
  frame.rays = gather_.rays() - std::exchange(countedRays_, gather_.rays());
  frame.texels = static_cast<std::uint32_t>(places.size());
  frame.waiting = static_cast<std::uint32_t>(waiting - places.size());
  blend(frame);
  return frame;
}

bool LiveGather::settled() const {
  const double mean = meanIrradiance();
  for (std::size_t i = 0; i < places_.size(); ++i)
    if (blendLeft_[i] > 0 || waits(i, mean)) return false;
  return true;
}

}  // namespace prelight
