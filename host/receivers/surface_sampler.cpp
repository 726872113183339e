#include "receivers/surface_sampler.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "base/parallel.h"
#include "base/spans.h"
#include "receivers/sampling.h"

namespace prelight {

namespace {

/// Rounding error of a point on a triangle and of the intersection test, relative to the largest coordinate:
/// a few ulp.
constexpr double liftPerMagnitude = 0x1p-19;

/// Least share of the way to the centroid by which samples are moved: one that rounding puts beyond an edge
/// would see past a wall that meets it there.
constexpr double leastInset = 0x1p-10;

/// Rounding error of a position, relative to the largest coordinate.
constexpr double roundingPerMagnitude = 0x1p-22;

double largestCoordinate(const CompiledScene& scene, std::uint32_t triangle) {
  const auto& t = scene.triangles[triangle];
  const glm::vec3 most = glm::max(glm::abs(scene.positions[t.x]),
                                  glm::max(glm::abs(scene.positions[t.y]), glm::abs(scene.positions[t.z])));
  return std::max({most.x, most.y, most.z});
}

/// Returns the share of the way to the centroid that keeps samples of a triangle off its edges by more than
/// rounding: with share i, a sample is at least i / 3 of a height away from each edge.
double insetOf(const CompiledScene& scene, std::uint32_t triangle, double area) {
  const auto& t = scene.triangles[triangle];
  const glm::dvec3 a(scene.positions[t.x]), b(scene.positions[t.y]), c(scene.positions[t.z]);
  const double longest = std::max({glm::length(b - a), glm::length(c - b), glm::length(a - c)});
  const double leastHeight = 2.0 * area / longest;
  const double share = 3.0 * roundingPerMagnitude * largestCoordinate(scene, triangle) / leastHeight;
  return std::clamp(share, leastInset, 0.5);
}

glm::dvec2 insetBy(double share, const glm::dvec2& weights) {
  return glm::mix(weights, glm::dvec2(1.0 / 3.0), share);
}

/// Moves bits 0, 1, 2 ... of x to positions 0, stride, 2 stride ...
std::uint64_t spread(std::uint64_t x, unsigned bits, unsigned stride) {
  std::uint64_t code = 0;
  for (unsigned i = 0; i < bits; ++i) code |= ((x >> i) & 1u) << (i * stride);
  return code;
}

std::uint64_t mortonCode(const glm::dvec2& u) {
  constexpr unsigned bits = 8;
  const glm::uvec2 cell(u * double(1u << bits));
  return spread(cell.x, bits, 2) << 1 | spread(cell.y, bits, 2);
}

constexpr std::size_t triangleRange = 4096;

/// Sorts distinct values like std::sort, on all cores.
template <typename T>
void sortRanges(std::vector<T>& values) {
  constexpr std::size_t range = std::size_t{1} << 15;
  const auto at = [&](std::size_t i) { return values.begin() + static_cast<std::ptrdiff_t>(i); };
  parallelRanges(values.size(), range,
                 [&](std::size_t begin, std::size_t end) { std::sort(at(begin), at(end)); });
  for (std::size_t sorted = range; sorted < values.size(); sorted *= 2)
    parallelRanges(values.size(), 2 * sorted, [&](std::size_t begin, std::size_t end) {
      std::inplace_merge(at(begin), at(std::min(begin + sorted, end)), at(end));
    });
}

/// Returns the triangles in order of the Morton codes of their centroids in a cube around all of them; equal
/// codes keep their order.
std::vector<std::uint32_t> mortonOrder(const CompiledScene& scene) {
  constexpr unsigned bits = 16;
  const std::size_t count = scene.triangles.size();
  std::vector<glm::vec3> centroids(count);
  parallelRanges(count, triangleRange, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const auto& t = scene.triangles[i];
      centroids[i] = scene.positions[t.x] / 3.0f + scene.positions[t.y] / 3.0f + scene.positions[t.z] / 3.0f;
    }
  });
  glm::vec3 low(std::numeric_limits<float>::max()), high(std::numeric_limits<float>::lowest());
  for (const glm::vec3& centroid : centroids) {
    low = glm::min(low, centroid);
    high = glm::max(high, centroid);
  }
  const glm::dvec3 extent = glm::dvec3(high) - glm::dvec3(low);
  const double size = std::max({extent.x, extent.y, extent.z, 1e-300});
  std::vector<std::pair<std::uint64_t, std::uint32_t>> keys(count);
  parallelRanges(count, triangleRange, [&](std::size_t begin, std::size_t end) {
    for (std::size_t t = begin; t < end; ++t) {
      const glm::uvec3 cell((glm::dvec3(centroids[t]) - glm::dvec3(low)) / size * double((1u << bits) - 1));
      keys[t] = {spread(cell.x, bits, 3) << 2 | spread(cell.y, bits, 3) << 1 | spread(cell.z, bits, 3),
                 static_cast<std::uint32_t>(t)};
    }
  });
  sortRanges(keys);
  std::vector<std::uint32_t> order(count);
  for (std::size_t i = 0; i < count; ++i) order[i] = keys[i].second;
  return order;
}

std::uint32_t seedOf(std::uint64_t seed, Side side) {
  return sampling::hashInteger(
      static_cast<std::uint32_t>(seed) ^
      sampling::hashInteger(static_cast<std::uint32_t>(seed >> 32) + 2u * static_cast<std::uint32_t>(side)));
}

}  // namespace

std::shared_ptr<SurfaceSampler::Surface> SurfaceSampler::surfaceOf(const CompiledScene& scene) {
  auto surface = std::make_shared<Surface>();
  surface->areas.resize(scene.triangleCount());
  parallelRanges(surface->areas.size(), triangleRange, [&](std::size_t begin, std::size_t end) {
    for (std::size_t t = begin; t < end; ++t)
      surface->areas[t] = 0.5 * glm::length(geometricNormal(scene, static_cast<std::uint32_t>(t)));
  });
  for (const double area : surface->areas) surface->totalArea += area;
  surface->shares.reserve(surface->areas.size());
  for (const double area : surface->areas)
    surface->shares.push_back(0.5 *
                              (area / surface->totalArea + 1.0 / static_cast<double>(surface->areas.size())));
  surface->order = mortonOrder(scene);
  return surface;
}

SurfaceSampler::SurfaceSampler(const CompiledScene& scene, std::uint64_t seed, Side side,
                               std::uint32_t replicates)
    : scene_(scene),
      seed_(seedOf(seed, side)),
      side_(side),
      surface_(surfaceOf(scene)),
      active_(scene.triangleCount(), 1),
      replicates_(replicates),
      thinned_(scene.triangleCount(), 0),
      position_{std::vector<std::uint32_t>(std::size_t{scene.triangleCount()} * replicates, 0), 0} {}

SurfaceSampler::SurfaceSampler(const SurfaceSampler& other, std::uint64_t seed, Side side)
    : scene_(other.scene_),
      seed_(seedOf(seed, side)),
      side_(side),
      surface_(other.surface_),
      active_(other.active_.size(), 1),
      replicates_(other.replicates_),
      thinned_(other.thinned_.size(), 0),
      position_{std::vector<std::uint32_t>(other.position_.taken.size(), 0), 0} {}

void SurfaceSampler::coverComponents(const FitMesh& mesh, double receivers, double least) {
  const std::vector<std::uint32_t>& components = mesh.components;
  std::vector<double>& shares = surface_->shares;
  std::vector<double> sums(mesh.slotCount(), 0.0);
  const auto sumOf = [&](std::size_t t) -> double& { return sums[components[mesh.triangles[t][0]]]; };
  for (std::size_t t = 0; t < shares.size(); ++t) sumOf(t) += shares[t];
  for (std::size_t t = 0; t < shares.size(); ++t) shares[t] *= std::max(1.0, least / (receivers * sumOf(t)));
}

glm::dvec3 orientedNormal(const CompiledScene& scene, std::uint32_t triangle) {
  return glm::normalize(geometricNormal(scene, triangle));
}

glm::dvec2 keptOffEdges(const CompiledScene& scene, std::uint32_t triangle, const glm::dvec2& weights) {
  const double area = 0.5 * glm::length(geometricNormal(scene, triangle));
  return insetBy(insetOf(scene, triangle, area), weights);
}

device::Receiver receiverAt(const CompiledScene& scene, const SurfaceSample& sample, Side side) {
  const auto& t = scene.triangles[sample.triangle];
  const double sign = side == Side::Front ? 1.0 : -1.0;
  const auto [b0, b1, b2] = cornerWeights(sample);
  const glm::dvec3 p0(scene.positions[t.x]), p1(scene.positions[t.y]), p2(scene.positions[t.z]);
  const glm::dvec3 geometric = orientedNormal(scene, sample.triangle) * sign;
  glm::dvec3 normal = geometric;
  if (!scene.triangleFlat[sample.triangle]) {
    normal = b0 * glm::dvec3(scene.normals[t.x]) + b1 * glm::dvec3(scene.normals[t.y]) +
             b2 * glm::dvec3(scene.normals[t.z]);
    const double length = glm::length(normal);
    normal = length > 1e-6 ? normal / length * sign : geometric;
    if (glm::dot(normal, geometric) < 0.0) normal = -normal;
  }
  const double lift = liftPerMagnitude * largestCoordinate(scene, sample.triangle);
  const glm::vec3 position(b0 * p0 + b1 * p1 + b2 * p2 + lift * geometric);
  const glm::vec3 n(normal), g(geometric);
  return {{position.x, position.y, position.z}, sample.triangle, {n.x, n.y, n.z}, 0, {g.x, g.y, g.z}, 0};
}

void SurfaceSampler::pass(double receivers, std::uint32_t raysPerReceiver, const Sink& sink) {
  constexpr std::size_t trianglesAhead = 4;
  // Systematic sampling: the running sum of expected counts is sampled at unit spacing, with an offset per
  // pass.
  double sum = sampling::sobol(position_.passes, seed_).x;
  const std::uint32_t replicate = position_.passes % replicates_;
  ++position_.passes;
  for (std::size_t first = 0; first < surface_->order.size(); first += pickedAtOnce) {
    pick(first, receivers, sum);
    for (std::size_t i = 0; i < picked_.size(); ++i) {
      if (i + trianglesAhead < picked_.size()) askFor(picked_[i + trianglesAhead].triangle);
      placeOn(picked_[i], replicate, raysPerReceiver, sink);
    }
  }
}

void SurfaceSampler::pick(std::size_t first, double receivers, double& sum) {
  constexpr std::size_t ahead = 32;
  const std::vector<std::uint32_t>& order = surface_->order;
  picked_.clear();
  for (std::size_t i = first; i < std::min(order.size(), first + pickedAtOnce); ++i) {
    if (i + ahead < order.size()) {
      prefetch(&active_[order[i + ahead]]);
      prefetch(&thinned_[order[i + ahead]]);
      prefetch(&surface_->shares[order[i + ahead]]);
    }
    const std::uint32_t t = order[i];
    if (!active_[t]) continue;
    const auto before = static_cast<std::uint64_t>(sum);
    sum += receivers * shareOf(t);
    const auto chosen = static_cast<std::uint64_t>(sum) - before;
    if (chosen == 0) continue;
    picked_.push_back({t, chosen});
    prefetch(&scene_.triangles[t]);
    prefetch(&surface_->areas[t]);
    prefetch(&scene_.triangleFlat[t]);
    prefetch(&position_.taken[std::size_t{t} * replicates_]);
  }
}

void SurfaceSampler::askFor(std::uint32_t triangle) const {
  const auto& t = scene_.triangles[triangle];
  for (const std::uint32_t v : {t.x, t.y, t.z}) {
    prefetch(&scene_.positions[v]);
    prefetch(&scene_.normals[v]);
  }
}

void SurfaceSampler::placeOn(const Picked& picked, std::uint32_t replicate, std::uint32_t raysPerReceiver,
                             const Sink& sink) {
  const std::uint32_t t = picked.triangle;
  const std::uint32_t sequence = t * replicates_ + replicate;
  choosePlaces(sequence, picked.receivers);
  const double inset = insetOf(scene_, t, surface_->areas[t]);
  for (const Place& chosenPlace : places_) {
    const glm::dvec2 b = insetBy(inset, sampling::uniformTriangle(chosenPlace.point));
    const SurfaceSample sample{t, static_cast<float>(b.x), static_cast<float>(b.y),
                               static_cast<float>(surface_->areas[t] / (surface_->totalArea * shareOf(t)))};
    device::Receiver receiver = receiverAt(scene_, sample, side_);
    setSequence(sequence, chosenPlace.index, raysPerReceiver, receiver);
    sink(sample, receiver);
  }
}

void SurfaceSampler::choosePlaces(std::uint32_t sequence, std::uint64_t count) {
  places_.clear();
  for (std::uint64_t i = 0; i < count; ++i) {
    const std::uint32_t index = position_.taken[sequence]++;
    const glm::dvec2 point = sampling::sobol(index, seed_ ^ sampling::hashInteger(2 * sequence));
    places_.push_back({index, mortonCode(point), point});
  }
  std::sort(places_.begin(), places_.end(), [](const Place& a, const Place& b) {
    return a.code != b.code ? a.code < b.code : a.index < b.index;
  });
}

void SurfaceSampler::setSequence(std::uint32_t sequence, std::uint32_t index, std::uint32_t raysPerReceiver,
                                 device::Receiver& receiver) const {
  receiver.seed = seed_ ^ sampling::hashInteger(2 * sequence + 1);
  receiver.firstSample =
      sampling::shuffledIndex(index, seed_ ^ sampling::hashInteger(~sequence)) * raysPerReceiver;
}

std::uint32_t triangleOf(const CompiledScene& scene, const LightMapTexel& texel) {
  return texel.face >= scene.triangleCount() ? texel.face - scene.triangleCount() : texel.face;
}

device::Receiver receiverAt(const CompiledScene& scene, const LightMapTexel& texel) {
  const std::uint32_t triangle = triangleOf(scene, texel);
  return receiverAt(scene, {triangle, texel.b1, texel.b2, 1.0f},
                    triangle == texel.face ? Side::Front : Side::Back);
}

}  // namespace prelight
