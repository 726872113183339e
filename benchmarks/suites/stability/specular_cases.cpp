#include <algorithm>
#include <cmath>

#include "basis/sh_evaluate.h"
#include "benchmarks/suites/stability/cases.h"
#include "cast/specular_column.h"
#include "device/kernel.h"
#include "gpu/tracer.h"
#include "shared/cast_types.h"

// Rays of a cast that continue from mirrors and glass.
namespace prelight::benchmarks::stability {

namespace {

using device::CastParameters;
using device::Hit;
using device::Ray;
using device::Receiver;
using device::Sender;
using device::SpecularEnd;

constexpr std::uint32_t specularReceivers = 24, specularRays = 64;
constexpr double metalReflectance = 0.75;  // along the normal, exact in float

Material mirrorMetal() {
  Material material;
  material.metallic = 1.0f;
  material.roughness = 0.0f;
  material.baseColor = glm::vec4(glm::vec3(static_cast<float>(metalReflectance)), 1.0f);
  return material;
}

/// Returns rays from above the middle of a floor of `half` down to it; some of them graze it.
std::vector<Ray> raysToFloor(double half) {
  Random random(51);
  std::vector<Ray> rays;
  for (std::uint32_t i = 0; i < specularReceivers * specularRays; ++i) {
    glm::dvec3 d = random.direction();
    d.y = i % 5 == 0 ? -1e-3 : -std::abs(d.y);
    d = glm::normalize(d);
    const glm::dvec3 place(half * random.between(-0.5, 0.5), 0.0, half * random.between(-0.5, 0.5));
    const glm::vec3 from(place - 0.2 * half * d), way(d);
    rays.push_back({{from.x, from.y, from.z}, PRELIGHT_NO_TRIANGLE, {way.x, way.y, way.z}, 1e30f});
  }
  return rays;
}

/// Measures a metal floor that mirrors the sky in Schlick's colours.
void mirroredSky(const char* stress, double half, int order, Trials& trials) {
  DeviceContext& device = trials.context();
  const CompiledScene scene = floorScene(half, 1, mirrorMetal());
  Tracer tracer(scene, trials.device());
  const std::vector<Ray> rays = raysToFloor(half);
  const CastParameters parameters{
      specularReceivers, specularRays, 0, scene.vertexCount(), 0, 0.0f, 0.0f, 0.0f};
  const Buffer<CastParameters> parameterBuffer(device, std::span(&parameters, 1));
  const Buffer<Receiver> receiverBuffer(device,
                                        std::span<const Receiver>(std::vector<Receiver>(specularReceivers)));
  const Buffer<Ray> rayBuffer(device, std::span<const Ray>(rays));
  Buffer<Hit> hits(device, rays.size());
  tracer.traceClosest(rayBuffer, hits, rays.size());
  SpecularCaster caster(scene, {true, false, order, nullptr}, tracer, rays.size(), specularRays);
  const CastBlockBuffers block{parameterBuffer, receiverBuffer, rayBuffer, hits};
  caster.cast(block, specularReceivers, tracer);
  std::vector<float> got;
  caster.project(block, specularReceivers, got);
  const auto n = static_cast<std::size_t>(order * order);
  Differences differences;
  std::vector<double> truth(n), y(n);
  for (std::size_t r = 0; r < specularReceivers; ++r) {
    std::fill(truth.begin(), truth.end(), 0.0);
    double magnitude = 0.0;
    for (std::size_t j = 0; j < specularRays; ++j) {
      const float* d = rays[r * specularRays + j].direction;
      const glm::dvec3 way = glm::normalize(glm::dvec3(d[0], -double(d[1]), d[2]));
      const double share =
          (metalReflectance + (1.0 - metalReflectance) * std::pow(1.0 - way.y, 5.0)) / specularRays;
      magnitude += share;
      sh::evaluate(way, order, y);
      for (std::size_t i = 0; i < n; ++i) truth[i] += share * y[i];
    }
    for (std::size_t k = 0; k < 3 * n; ++k) {
      const double band = std::floor(std::sqrt(double(k % n) + 0.5));
      differences.add(got[r * 3 * n + k], truth[k % n],
                      magnitude * std::sqrt((2.0 * band + 1.0) / (4.0 * pi)));
    }
  }
  trials.record(stress, differences, sumBound(specularRays + 16.0) + 32.0 * order * unitRoundoff,
                {"order", double(order)});
}

SpecularEnd endOf(std::uint32_t i, double throughput) {
  const auto share = static_cast<float>(throughput);
  const std::uint32_t kind = i % 6;
  return {{share, share, share}, kind, {0.0f, i % 4 < 2 ? 1.0f : -1.0f, 0.0f}, i % 2, 0.25f, 0.5f};
}

/// Measures stored ends of paths. Albedos have ten bits per channel; those above 1 are stored as values that
/// are doubled up to three times.
void storedEnds(double throughput, Trials& trials) {
  DeviceContext& device = trials.context();
  constexpr double albedo = 0.5;
  const CompiledScene scene = floorScene(1.0, 1, matte(albedo));
  const Tracer tracer(scene, trials.device());
  std::vector<SpecularEnd> ends;
  for (std::uint32_t i = 0; i < specularReceivers * specularRays; ++i) ends.push_back(endOf(i, throughput));
  const Sender before{7u, 99u};
  const CastParameters parameters{
      specularReceivers, specularRays, 0, scene.vertexCount(), 0, 0.0f, 0.0f, 0.0f};
  const Buffer<CastParameters> parameterBuffer(device, std::span(&parameters, 1));
  const Buffer<Receiver> receiverBuffer(device,
                                        std::span<const Receiver>(std::vector<Receiver>(specularReceivers)));
  const Buffer<SpecularEnd> endBuffer(device, std::span<const SpecularEnd>(ends));
  const Buffer<float> normals(device, std::span<const float>(std::vector<float>{0, 1, 0, 0, 1, 0}));
  const Buffer<Sender> senders(device, std::span<const Sender>(std::vector<Sender>(ends.size(), before)));
  Buffer<std::uint8_t> marks(device, 2);
  marks.fill(0);
  launchOnce(device, "cast/transport_kernels.cl",
             tracer.surfaceOptions().define("PRELIGHT_COLUMNS", 1).define("PRELIGHT_FOLLOWED", 1),
             "storeFollowed", {ends.size(), 8}, parameterBuffer, tracer.scene().layoutBuffer(),
             tracer.scene().surface(), normals, receiverBuffer, endBuffer, senders, marks);
  const std::vector<Sender> got = senders.read();
  Differences differences;
  for (std::size_t i = 0; i < got.size(); ++i) {
    const std::uint32_t kind = ends[i].kind;
    if (kind == PRELIGHT_SPECULAR_MET_NONE) {
      differences.decide(got[i].vertex == before.vertex && got[i].albedo == before.albedo);
      continue;
    }
    const double sent = throughput * (kind == PRELIGHT_SPECULAR_SURFACE ? albedo : 1.0);
    if (kind < PRELIGHT_SPECULAR_SURFACE || sent < 0.5 / 1023.0) {
      differences.decide(got[i].vertex == PRELIGHT_NO_TRIANGLE);
      continue;
    }
    const bool back = (ends[i].direction[1] > 0.0f) != (kind == PRELIGHT_SPECULAR_THROUGH);
    const glm::uvec3& t = scene.triangles[ends[i].triangle];
    const std::uint32_t vertex = got[i].vertex - (back ? scene.vertexCount() : 0u);
    differences.decide(vertex == t.x || vertex == t.y || vertex == t.z);
    const double scale = double(1u << (got[i].albedo >> 30));
    for (int c = 0; c < 3; ++c)
      differences.add(scale * (got[i].albedo >> (10 * c) & 1023u) / 1023.0, sent, scale);
  }
  trials.record("ends of every kind", differences, 0.5 / 1023.0 + 4.0 * unitRoundoff,
                {"throughput", throughput});
}

}  // namespace

void runSpecular(Trials& trials) {
  for (const int order : trials.options().orders)
    if (order <= 16) mirroredSky("a floor of 1 m", 1.0, order, trials);
  mirroredSky("a floor of 1e-5 m", 1e-5, 3, trials);
  mirroredSky("a floor of 1e5 m", 1e5, 3, trials);
  for (const double throughput : {0.0, 1e-6, 0.3, 1.0, 1.7, 7.9}) storedEnds(throughput, trials);
}

}  // namespace prelight::benchmarks::stability
