#include "benchmarks/suites/tracing/ray_sets.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>

#include "receivers/sampling.h"
#include "receivers/surface_sampler.h"
#include "shared/cast_types.h"

namespace prelight::benchmarks {

namespace {

using device::CastParameters;
using device::Hit;
using device::Ray;
using device::Receiver;

constexpr std::uint32_t seed = 1;

std::vector<Receiver> placeReceivers(const CompiledScene& scene, double count,
                                     std::uint32_t raysPerReceiver) {
  std::vector<Receiver> receivers;
  SurfaceSampler(scene, seed, Side::Front)
      .pass(count, raysPerReceiver,
            [&](const SurfaceSample&, const Receiver& receiver) { receivers.push_back(receiver); });
  return receivers;
}

/// Generates rays by the kernel of bakes, one launch at a time.
std::vector<Ray> generateRays(const CompiledScene& scene, DeviceContext& device,
                              std::span<const Receiver> receivers, std::uint32_t raysPerReceiver) {
  const std::size_t block = std::max<std::size_t>(1, raysPerLaunch(device.info()) / raysPerReceiver);
  Buffer<CastParameters> parameterBuffer(device, 1);
  Buffer<Ray> rayBuffer(device, block * raysPerReceiver);
  Kernel<Buffer<CastParameters>, Buffer<Receiver>, Buffer<Ray>> generate(device, "cast/generate_kernels.cl",
                                                                         {}, "generateRays");
  std::vector<Ray> rays(receivers.size() * raysPerReceiver);
  for (std::size_t first = 0; first < receivers.size(); first += block) {
    const auto some = receivers.subspan(first, std::min(block, receivers.size() - first));
    const CastParameters parameters{static_cast<std::uint32_t>(some.size()),
                                    raysPerReceiver,
                                    0,
                                    scene.vertexCount(),
                                    0,
                                    0.0f,
                                    0.0f,
                                    0.0f};
    parameterBuffer.write(std::span(&parameters, 1));
    Buffer<Receiver> receiverBuffer(device, some);
    // A work-item generates eight rays.
    generate.launch(some.size() * raysPerReceiver / 8, parameterBuffer, receiverBuffer, rayBuffer);
    rayBuffer.read(std::span(rays).subspan(first * raysPerReceiver, some.size() * raysPerReceiver));
  }
  return rays;
}

Ray makeRay(const glm::dvec3& origin, const glm::dvec3& direction, std::uint32_t source) {
  const glm::vec3 o(origin), d(direction);
  return {{o.x, o.y, o.z}, source, {d.x, d.y, d.z}, std::numeric_limits<float>::max()};
}

glm::dvec3 sphereDirection(const glm::dvec2& u) {
  const double z = 1.0 - 2.0 * u.x, r = std::sqrt(std::max(0.0, 1.0 - z * z));
  return {r * std::cos(2.0 * std::numbers::pi * u.y), r * std::sin(2.0 * std::numbers::pi * u.y), z};
}

/// Returns a cosine-weighted ray that starts where `ray` has hit, on the side that it came from.
Ray scatter(const CompiledScene& scene, const Ray& ray, const Hit& hit, const glm::dvec2& u) {
  const glm::uvec3& t = scene.triangles[hit.triangle];
  const glm::dvec3 p0(scene.positions[t.x]), p1(scene.positions[t.y]), p2(scene.positions[t.z]);
  const glm::dvec3 place = p0 + double(hit.u) * (p1 - p0) + double(hit.v) * (p2 - p0);
  const glm::dvec3 incoming(ray.direction[0], ray.direction[1], ray.direction[2]);
  glm::dvec3 normal = glm::normalize(geometricNormal(scene, hit.triangle));
  if (glm::dot(normal, incoming) > 0.0) normal = -normal;
  const double lift = 0x1p-19 * std::max({std::abs(place.x), std::abs(place.y), std::abs(place.z)});
  return makeRay(place + lift * normal, sampling::cosineHemisphere(u, normal), hit.triangle);
}

}  // namespace

std::size_t raysPerLaunch(const DeviceInfo& info) {
  return info.kind == DeviceKind::Gpu ? std::size_t{1} << 21 : std::size_t{1} << 16;
}

std::vector<Ray> bakeRays(const CompiledScene& scene, DeviceContext& device, std::uint64_t count,
                          std::uint32_t raysPerReceiver) {
  return generateRays(scene, device,
                      placeReceivers(scene, static_cast<double>(count) / raysPerReceiver, raysPerReceiver),
                      raysPerReceiver);
}

std::vector<Ray> bakeLaunches(const CompiledScene& scene, DeviceContext& device, std::uint64_t count,
                              std::uint32_t raysPerReceiver) {
  const std::uint64_t launchSize = std::min<std::uint64_t>(count, raysPerLaunch(device.info()));
  const std::size_t block = std::max<std::size_t>(1, launchSize / raysPerReceiver);
  const std::size_t launches = std::max<std::uint64_t>(1, count / launchSize);
  const double wanted = std::max(1.0 * scene.triangleCount(), 1.0 * static_cast<double>(launches * block));
  const std::vector<Receiver> all = placeReceivers(scene, wanted, raysPerReceiver);
  std::vector<Receiver> taken;
  for (std::size_t l = 0; l < launches; ++l) {
    const std::size_t first = std::min(all.size() * l / launches, all.size() - std::min(all.size(), block));
    taken.insert(taken.end(), all.begin() + static_cast<std::ptrdiff_t>(first),
                 all.begin() + static_cast<std::ptrdiff_t>(std::min(all.size(), first + block)));
  }
  return generateRays(scene, device, taken, raysPerReceiver);
}

std::vector<Ray> shuffled(std::vector<Ray> rays) {
  std::shuffle(rays.begin(), rays.end(), std::mt19937_64(seed));
  return rays;
}

std::vector<Ray> limited(std::vector<Ray> rays, float reach) {
  for (Ray& ray : rays) ray.tMax = reach;
  return rays;
}

std::vector<Ray> cameraRays(const BenchmarkScene& scene, std::uint64_t count) {
  constexpr int tile = 8;
  const int tiles = std::max(1, static_cast<int>(std::sqrt(static_cast<double>(count))) / tile);
  const Camera& camera = scene.scene.cameras.at(0);
  const glm::dvec3 eye = glm::dvec3(camera.world[3]) - scene.compiled.origin;
  const double slope = std::tan(0.5 * camera.yFov);
  std::vector<Ray> rays;
  for (int t = 0; t < tiles * tiles; ++t)
    for (int p = 0; p < tile * tile; ++p) {
      const glm::dvec2 pixel(t % tiles * tile + p % tile, t / tiles * tile + p / tile);
      const glm::dvec2 at = slope * (2.0 * (pixel + 0.5) / (1.0 * tiles * tile) - 1.0);
      const glm::dvec3 direction = glm::normalize(glm::dmat3(camera.world) * glm::dvec3(at.x, -at.y, -1.0));
      rays.push_back(makeRay(eye, direction, PRELIGHT_NO_TRIANGLE));
    }
  return rays;
}

std::vector<Ray> photonRays(const BenchmarkScene& scene, Tracer& tracer, std::uint64_t count) {
  constexpr std::size_t rounds = 4;  // the flight from the light and three bounces
  const std::size_t photons = std::min<std::uint64_t>(count, raysPerLaunch(tracer.context().info())) / rounds;
  const std::vector<Light>& lights = scene.scene.lights;
  std::vector<Ray> all;
  for (std::uint32_t first = 0; all.size() < count; first += static_cast<std::uint32_t>(photons)) {
    std::vector<Ray> rays;
    for (std::uint32_t p = first; p < first + photons; ++p)
      rays.push_back(makeRay(lights[p % lights.size()].position - scene.compiled.origin,
                             sphereDirection(sampling::sobol(p, seed)), PRELIGHT_NO_TRIANGLE));
    for (std::uint32_t round = 1; !rays.empty(); ++round) {
      all.insert(all.end(), rays.begin(), rays.end());
      if (round == rounds) break;
      const std::vector<Hit> hits = tracer.traceClosest(std::span<const Ray>(rays));
      std::vector<Ray> next;
      for (std::size_t i = 0; i < rays.size(); ++i) {
        if (hits[i].triangle == PRELIGHT_NO_TRIANGLE) continue;
        const std::uint32_t index = sampling::hashInteger(first + static_cast<std::uint32_t>(i));
        next.push_back(scatter(scene.compiled, rays[i], hits[i], sampling::sobol(index, seed + round)));
      }
      rays = std::move(next);
    }
  }
  all.resize(count);
  return all;
}

RayBlocks::RayBlocks(DeviceContext& device, std::span<const Ray> rays)
    : device_(device), count_(rays.size()) {
  const std::size_t block = std::min(rays.size(), raysPerLaunch(device.info()));
  hits_ = Buffer<Hit>(device, block);
  for (std::size_t first = 0; first < rays.size(); first += block)
    launches_.emplace_back(device, rays.subspan(first, std::min(block, rays.size() - first)));
}

void RayBlocks::launch(Tracer& tracer, bool any, std::size_t index) {
  const Buffer<Ray>& rays = launches_[index];
  any ? tracer.traceAny(rays, hits_, rays.size()) : tracer.traceClosest(rays, hits_, rays.size());
}

void RayBlocks::trace(Tracer& tracer, bool any, std::size_t first, std::size_t last) {
  for (std::size_t i = first; i < last; ++i) launch(tracer, any, i);
  device_.finish();
}

std::vector<Hit> RayBlocks::hits(Tracer& tracer, bool any) {
  std::vector<Hit> all(count_);
  std::size_t first = 0;
  for (std::size_t i = 0; i < launches_.size(); ++i) {
    launch(tracer, any, i);
    hits_.read(std::span(all).subspan(first, launches_[i].size()));
    first += launches_[i].size();
  }
  return all;
}

}  // namespace prelight::benchmarks
