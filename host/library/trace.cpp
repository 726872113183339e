#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "base/directions.h"
#include "base/parallel.h"
#include "gpu/tracer.h"
#include "library/library_call.h"
#include "library/open_scene.h"
#include "photon/photon_tracer.h"
#include "prelight/error.h"
#include "prelight/options.h"
#include "prelight/photons.h"
#include "prelight/trace.h"

namespace prelight {

namespace {

bool isFinite(const glm::dvec3& v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }

device::Ray deviceRay(const Ray& ray, std::size_t index, const glm::dvec3& origin) {
  const double length = glm::length(ray.direction);
  if (!isFinite(ray.origin) || !isFinite(ray.direction) || !(length > 0.0) || !(ray.farthest >= 0.0))
    throw UsageError(fmt::format("Ray {}", index),
                     "expected a finite origin, a direction that is not 0, and farthest >= 0");
  const glm::vec3 from(ray.origin - origin), to(ray.direction / length);
  return {{from.x, from.y, from.z},
          PRELIGHT_NO_TRIANGLE,
          {to.x, to.y, to.z},
          static_cast<float>(std::min<double>(ray.farthest, std::numeric_limits<float>::max()))};
}

std::size_t primitiveOf(const CompiledScene& scene, std::uint32_t triangle) {
  const auto next =
      std::upper_bound(scene.primitives.begin(), scene.primitives.end(), triangle,
                       [](std::uint32_t t, const PrimitiveRange& range) { return t < range.firstTriangle; });
  return static_cast<std::size_t>(next - scene.primitives.begin()) - 1;
}

RayHit hitOf(const Ray& ray, const device::Hit& hit, const CompiledScene& scene) {
  return {.distance = hit.t,
          .triangle = hit.triangle,
          .primitive = primitiveOf(scene, hit.triangle),
          .weights = {hit.u, hit.v},
          .position = ray.origin + double(hit.t) * glm::normalize(ray.direction),
          .normal = glm::normalize(geometricNormal(scene, hit.triangle))};
}

/// Rays per transfer to the device and back: few enough to stay in the processor's caches, and enough to make
/// the cost of a launch negligible.
constexpr std::size_t raysPerBlock = std::size_t{1} << 17;
constexpr std::size_t raysPerRange = std::size_t{1} << 14;

void requireLengths(const RayArrays& rays, std::size_t results) {
  if (rays.directions.size() != rays.origins.size())
    throw UsageError("RayArrays::directions", fmt::format("got {}, expected one per ray: {}",
                                                          rays.directions.size(), rays.origins.size()));
  if (!rays.farthest.empty() && rays.farthest.size() != rays.origins.size())
    throw UsageError("RayArrays::farthest", fmt::format("got {}, expected one per ray: {}, or none",
                                                        rays.farthest.size(), rays.origins.size()));
  if (results != rays.origins.size())
    throw UsageError("RayTracer", fmt::format("got room for {} results, expected one per ray: {}", results,
                                              rays.origins.size()));
}

/// Returns 1 / length. Squares overflow or underflow in float long before the components do. Most directions
/// are unit vectors up to rounding, for which a Newton step is as precise as a root and much faster.
float inverseLength(const glm::vec3& v) {
  constexpr float nearlyUnit = 1e-4f;  // the step's error is 3/8 of its square
  const float square = glm::dot(v, v);
  if (std::abs(square - 1.0f) < nearlyUnit) return 1.5f - 0.5f * square;
  if (square > 1e-30f && square < 1e30f) return 1.0f / std::sqrt(square);
  return static_cast<float>(1.0 / glm::length(glm::dvec3(v)));
}

[[noreturn]] void refuseRay(std::size_t index) {
  throw UsageError(fmt::format("Ray {}", index),
                   "expected a finite origin, a direction that is not 0, and farthest >= 0");
}

/// Packs a ray for the device, relative to the scene's origin, which is `high` + `low`: its value in float
/// and the remainder.
device::Ray packedRay(const RayArrays& rays, std::size_t index, float farthest, const glm::vec3& high,
                      const glm::vec3& low) {
  const glm::vec3& direction = rays.directions[index];
  const glm::vec3 from = (rays.origins[index] - high) - low, to = direction * inverseLength(direction);
  // The sum is finite only if all terms are.
  const float sum = from.x + from.y + from.z + to.x + to.y + to.z;
  if (!(std::abs(sum) <= std::numeric_limits<float>::max()) || !(farthest >= 0.0f)) refuseRay(index);
  return {{from.x, from.y, from.z}, PRELIGHT_NO_TRIANGLE, {to.x, to.y, to.z}, farthest};
}

/// Packs rays [first, first + count) for the device.
void packRays(const RayArrays& rays, std::size_t first, std::size_t count, const glm::vec3& high,
              const glm::vec3& low, device::Ray* packed) {
  constexpr float unlimited = std::numeric_limits<float>::max();
  if (rays.farthest.empty()) {
    for (std::size_t i = 0; i < count; ++i) packed[i] = packedRay(rays, first + i, unlimited, high, low);
  } else {
    for (std::size_t i = 0; i < count; ++i)
      packed[i] = packedRay(rays, first + i, std::min(rays.farthest[first + i], unlimited), high, low);
  }
}

}  // namespace

struct RayTracer::State {
  /// Rays that are transferred together, with their hits.
  struct RayBlock {
    std::size_t first = 0;  ///< index among all rays
    std::size_t count = 0;
    DeviceLane lane;
    Buffer<device::Ray> rays;
    Buffer<device::Hit> hits;
  };

  std::optional<Device> opened;
  std::optional<Tracer> tracer;                         ///< none if the scene has no triangle
  glm::vec3 originHigh{0.0f}, originLow{0.0f};          ///< as packedRay() takes them
  std::array<RayBlock, DeviceLane::count> blocks = {};  ///< one is traced while the next is packed

  /// Starts tracing the rays from `first` on.
  void start(const RayArrays& all, std::size_t first, bool any, RayBlock& block) {
    block.first = first;
    block.count = std::min(all.origins.size() - first, raysPerBlock);
    {
      const auto packed = block.rays.overwritten(block.count);
      parallelRanges(block.count, raysPerRange, [&](std::size_t begin, std::size_t end) {
        packRays(all, first + begin, end - begin, originHigh, originLow, &packed[begin]);
      });
    }
    any ? tracer->traceAny(block.rays, block.hits, block.count, 0, block.lane)
        : tracer->traceClosest(block.rays, block.hits, block.count, 0, block.lane);
  }

  /// Makes room for at least `count` rays in the first `used` blocks.
  void reserve(std::size_t count, std::size_t used) {
    for (std::size_t lane = 0; lane < used; ++lane) {
      RayBlock& block = blocks[lane];
      if (block.rays.size() >= count) continue;
      block.lane = {lane};
      block.rays = {tracer->context(), count, block.lane};
      block.hits = {tracer->context(), count, block.lane};
    }
  }

  /// Calls take(ray, hit) for all rays, on all cores. Does nothing for scenes without triangles.
  template <typename Take>
  void forEachHit(const RayArrays& all, bool any, const Take& take) {
    const std::size_t total = all.origins.size();
    if (!tracer || total == 0) return;
    reserve(std::min(total, raysPerBlock), total > raysPerBlock ? blocks.size() : 1);
    start(all, 0, any, blocks[0]);
    for (std::size_t b = 0; b * raysPerBlock < total; ++b) {
      const std::size_t next = (b + 1) * raysPerBlock;
      if (next < total) start(all, next, any, blocks[(b + 1) % blocks.size()]);
      const RayBlock& block = blocks[b % blocks.size()];
      const auto found = block.hits.mapped(block.count);
      parallelRanges(block.count, raysPerRange, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) take(block.first + i, found[i]);
      });
    }
  }
};

RayTracer::RayTracer(const LoadedScene& scene, const TraceOptions& options)
    : state_(std::make_unique<State>()) {
  state_->originHigh = scene.compiled.origin;
  state_->originLow = scene.compiled.origin - glm::dvec3(state_->originHigh);
  if (scene.compiled.triangleCount() == 0) return;
  if (options.device == nullptr) state_->opened.emplace(Device::open({}));
  state_->tracer.emplace(scene.compiled, options.device != nullptr ? *options.device : *state_->opened);
}

RayTracer::RayTracer(RayTracer&&) noexcept = default;
RayTracer& RayTracer::operator=(RayTracer&&) noexcept = default;
RayTracer::~RayTracer() = default;

void RayTracer::closest(const RayArrays& rays, std::span<ArrayHit> hits) {
  requireLengths(rays, hits.size());
  if (!state_->tracer) std::fill(hits.begin(), hits.end(), ArrayHit{});
  state_->forEachHit(rays, false, [&](std::size_t ray, const device::Hit& hit) {
    hits[ray] = hit.triangle == PRELIGHT_NO_TRIANGLE
                    ? ArrayHit{}
                    : ArrayHit{hit.t, static_cast<std::int32_t>(hit.triangle), {hit.u, hit.v}};
  });
}

void RayTracer::blocked(const RayArrays& rays, std::span<std::uint8_t> blocked) {
  requireLengths(rays, blocked.size());
  if (!state_->tracer) std::fill(blocked.begin(), blocked.end(), std::uint8_t{0});
  state_->forEachHit(rays, true, [&](std::size_t ray, const device::Hit& hit) {
    blocked[ray] = hit.triangle == PRELIGHT_NO_TRIANGLE ? 0 : 1;
  });
}

std::vector<std::optional<RayHit>> trace(const LoadedScene& scene, std::span<const Ray> rays,
                                         const TraceOptions& options) {
  std::vector<std::optional<RayHit>> found(rays.size());
  std::vector<device::Ray> deviceRays;
  deviceRays.reserve(rays.size());
  for (std::size_t i = 0; i < rays.size(); ++i)
    deviceRays.push_back(deviceRay(rays[i], i, scene.compiled.origin));
  if (rays.empty() || scene.compiled.triangleCount() == 0) return found;
  LibraryCall call(options.device);
  Tracer tracer(scene.compiled, call.device());
  const std::vector<device::Hit> hits = tracer.traceClosest(deviceRays);
  for (std::size_t i = 0; i < rays.size(); ++i)
    if (hits[i].triangle != PRELIGHT_NO_TRIANGLE) found[i] = hitOf(rays[i], hits[i], scene.compiled);
  return found;
}

namespace {

LandedPhoton landed(const device::Photon& photon, std::uint32_t path, const CompiledScene& scene) {
  return {.position = scene.origin + glm::dvec3(photon.position[0], photon.position[1], photon.position[2]),
          .power = {photon.power[0], photon.power[1], photon.power[2]},
          .direction = glm::vec3(unpackDirection(photon.direction)),
          .triangle = photon.triangle,
          .path = path};
}

}  // namespace

PhotonResult photons(const LoadedScene& scene, const PhotonOptions& options) {
  requireTriangles(scene.path, scene.compiled, "for photons to land on");
  requireRanges(options);
  LibraryCall call(options.device, options.progress);
  TransportScene transport(litScene(scene, options.lights, options.sky, options.skyRotation), call.device());
  PhotonHits hits;
  const PhotonReport report =
      PhotonTracer(scene.compiled, transport)
          .trace({.kind = options.kind, .photons = options.photons, .seed = options.seed}, hits,
                 call.progress());
  PhotonResult result;
  result.photons.reserve(hits.photons.size());
  for (std::size_t i = 0; i < hits.photons.size(); ++i)
    result.photons.push_back(landed(hits.photons[i], hits.paths[i], scene.compiled));
  result.sent = report.emitted;
  result.rays = report.rays;
  result.emitted = report.power.watts(report.power.emitted);
  result.absorbed = report.power.watts(report.power.absorbed);
  result.escaped = report.power.watts(report.power.escaped);
  return result;
}

}  // namespace prelight
