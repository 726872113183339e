#include <algorithm>
#include <array>
#include <cmath>

#include "basis/sh_evaluate.h"
#include "benchmarks/suites/stability/cases.h"
#include "device/kernel.h"
#include "gpu/tracer.h"
#include "receivers/sampling.h"
#include "shared/cast_types.h"

// Voxels and rows of stored transport.
namespace prelight::benchmarks::stability {

namespace {

using device::CastParameters;
using device::Hit;
using device::Ray;
using device::Receiver;
using device::Sender;

constexpr std::uint32_t voxels = 24, rayCount = 64;

std::vector<Ray> generate(const glm::vec4& lowerAndCell, std::uint32_t first, Trials& trials) {
  DeviceContext& device = trials.context();
  const CastParameters parameters{voxels, rayCount, 0, 0, 0, 0.0f, 0.0f, 0.0f};
  const Buffer<CastParameters> parameterBuffer(device, std::span(&parameters, 1));
  const Buffer<Ray> rays(device, std::size_t{voxels} * rayCount);
  launchOnce(device, "techniques/volume/volume_kernels.cl", BuildOptions().define("PRELIGHT_SH_ORDER", 1),
             "generateVolumeRays", {rays.size() / 8, 8}, parameterBuffer, lowerAndCell,
             glm::uvec4(512, 512, 512, first), std::uint32_t{7}, rays);
  return rays.read();
}

/// Measures the rays of a block, which are those of the sequence in some order. They are compared sorted by
/// height, which the first coordinate decides.
void volumeRays(const char* stress, const glm::vec4& grid, std::uint32_t first, Trials& trials) {
  const std::vector<Ray> rays = generate(grid, first, trials);
  Differences differences;
  for (std::uint32_t i = 0; i < voxels; ++i) {
    const std::uint32_t voxel = first + i;
    const glm::dvec3 cell(voxel % 512, voxel / 512 % 512, voxel / (512 * 512));
    const glm::dvec3 centre = glm::dvec3(grid) + double(grid.w) * (cell + 0.5);
    std::vector<std::pair<double, double>> exact, got;
    for (std::uint32_t j = 0; j < rayCount; ++j) {
      const glm::dvec2 u = sampling::sobol(j, sampling::hashInteger(voxel ^ sampling::hashInteger(7)));
      const double z = 1.0 - 2.0 * u.x;
      exact.emplace_back(z, std::sqrt(std::max(1.0 - z * z, 0.0)) * std::cos(2.0 * pi * u.y));
      const Ray& ray = rays[i * rayCount + j];
      got.emplace_back(ray.direction[2], ray.direction[0]);
      const double magnitude = std::max({std::abs(double(grid.x)), std::abs(double(grid.y)),
                                         std::abs(double(grid.z)), 512.0 * double(grid.w)});
      for (int axis = 0; axis < 3; ++axis) differences.add(ray.origin[axis], centre[axis], magnitude);
    }
    std::sort(exact.begin(), exact.end());
    std::sort(got.begin(), got.end());
    for (std::uint32_t j = 0; j < rayCount; ++j) {
      differences.add(got[j].first, exact[j].first, 1.0);
      differences.add(got[j].second, exact[j].second, 1.0);
    }
  }
  trials.record(stress, differences, std::sqrt(unitRoundoff));
}

/// Returns hits of half of the rays on two triangles.
std::vector<Hit> someHits(std::size_t count) {
  Random random(101);
  std::vector<Hit> hits;
  for (std::size_t i = 0; i < count; ++i) {
    const bool hit = random.unit() < double(i / rayCount) / (voxels - 1);
    const auto u = static_cast<float>(random.between(0.0, 0.5)),
               v = static_cast<float>(random.between(0.0, 0.5));
    hits.push_back({1.0f, hit ? random.bits() % 2 : PRELIGHT_NO_TRIANGLE, u, v});
  }
  return hits;
}

void projectVoxels(int order, Trials& trials) {
  DeviceContext& device = trials.context();
  const std::vector<Ray> rays = generate({-1, -1, -1, 0.01f}, 0, trials);
  const std::vector<Hit> hits = someHits(rays.size());
  const auto n = static_cast<std::size_t>(order * order);
  const CastParameters parameters{voxels, rayCount, 0, 0, 0, 0.0f, 0.0f, 0.0f};
  const Buffer<CastParameters> parameterBuffer(device, std::span(&parameters, 1));
  const Buffer<float> table(device, std::span<const float>(makeShTable(order)));
  const Buffer<Ray> rayBuffer(device, std::span<const Ray>(rays));
  const Buffer<Hit> hitBuffer(device, std::span<const Hit>(hits));
  const Buffer<float> normals(device, std::span<const float>(std::vector<float>{0, 1, 0, 0, 1, 0}));
  const Buffer<std::uint8_t> twoSided(device, std::span<const std::uint8_t>(std::vector<std::uint8_t>{1, 1}));
  const Buffer<float> values(device, voxels * (1 + n));
  launchOnce(device, "techniques/volume/volume_kernels.cl", BuildOptions().define("PRELIGHT_SH_ORDER", order),
             "projectVolume", {voxels, 8}, parameterBuffer, table, rayBuffer, hitBuffer, normals, twoSided,
             values);
  const std::vector<float> got = values.read();
  Differences differences;
  std::vector<double> y(n);
  for (std::size_t v = 0; v < voxels; ++v) {
    double open = 0.0;
    for (std::size_t j = 0; j < rayCount; ++j)
      open += (hits[v * rayCount + j].triangle == PRELIGHT_NO_TRIANGLE ? 1.0 : 0.0) / rayCount;
    std::vector<double> truth(n, 0.0);
    for (std::size_t j = 0; j < rayCount; ++j) {
      const float* d = rays[v * rayCount + j].direction;
      sh::evaluate(glm::normalize(glm::dvec3(d[0], d[1], d[2])), order, y);
      const double weight =
          ((hits[v * rayCount + j].triangle == PRELIGHT_NO_TRIANGLE ? 1.0 : 0.0) - open) / rayCount;
      for (std::size_t i = 0; i < n; ++i) truth[i] += weight * y[i];
    }
    truth[0] += open / std::sqrt(4.0 * pi);
    for (std::size_t i = 0; i < n; ++i)
      differences.add(got[v * (1 + n) + 1 + i], truth[i],
                      std::sqrt((2.0 * std::floor(std::sqrt(double(i) + 0.5)) + 1.0) / (4.0 * pi)));
  }
  trials.record("voxels from closed to open", differences,
                (rayCount / 8.0 + 8.0 + 8.0 * order) * unitRoundoff, {"order", double(order)});
}

/// Two triangles of a white or grey material, whose transfer is known at each vertex.
struct Senders {
  CompiledScene scene;
  Tracer tracer;
  std::vector<float> transfer;
  static constexpr std::uint32_t columns = 4;

  Senders(double albedo, double magnitude, Trials& trials)
      : scene(floorScene(1.0, 1, matte(albedo))), tracer(scene, trials.device()) {
    transfer = Random(102).floats(2 * std::size_t{scene.vertexCount()} * 3 * columns, magnitude);
  }
};

/// Order of SH of the transfer by direction.
constexpr int sentOrder = 3;
constexpr std::size_t sentBands = sentOrder * sentOrder;

/// Returns the light that the hit surface sends back along a ray, for one coefficient of transfer in a
/// channel.
double sentAlong(const Senders& senders, const Ray& ray, const Hit& hit, double albedo, std::size_t number) {
  if (hit.triangle == PRELIGHT_NO_TRIANGLE) return 0.0;
  const bool back = ray.direction[1] > 0.0f;
  const std::array<double, 3> weights{1.0 - double(hit.u) - double(hit.v), double(hit.u), double(hit.v)};
  double sum = 0.0;
  for (int corner = 0; corner < 3; ++corner) {
    const std::size_t slot =
        senders.scene.triangles[hit.triangle][corner] + (back ? senders.scene.vertexCount() : 0u);
    sum += weights[static_cast<std::size_t>(corner)] * double(static_cast<float>(albedo)) *
           double(senders.transfer[slot * 3 * Senders::columns + number]);
  }
  return sum;
}

void gatherVoxels(const char* stress, double albedo, double magnitude, Trials& trials) {
  DeviceContext& device = trials.context();
  const Senders senders(albedo, magnitude, trials);
  const std::vector<Ray> rays = generate({-1, -1, -1, 0.01f}, 0, trials);
  const std::vector<Hit> hits = someHits(rays.size());
  constexpr std::size_t width = 3 * Senders::columns * sentBands;
  const CastParameters parameters{voxels, rayCount, 0, senders.scene.vertexCount(), 0, 0.0f, 0.0f, 0.0f};
  const Buffer<CastParameters> parameterBuffer(device, std::span(&parameters, 1));
  const Buffer<Ray> rayBuffer(device, std::span<const Ray>(rays));
  const Buffer<Hit> hitBuffer(device, std::span<const Hit>(hits));
  const Buffer<float> normals(device, std::span<const float>(std::vector<float>{0, 1, 0, 0, 1, 0}));
  const Buffer<float> transfer(device, std::span<const float>(senders.transfer)),
      values(device, voxels * width);
  launchOnce(device, "techniques/volume/volume_kernels.cl",
             senders.tracer.surfaceOptions()
                 .define("PRELIGHT_SH_ORDER", 2)
                 .define("PRELIGHT_COLUMNS", Senders::columns)
                 .define("PRELIGHT_SENT_ORDER", sentOrder),
             "gatherVolume", {voxels, 8}, parameterBuffer, senders.tracer.scene().layoutBuffer(),
             senders.tracer.scene().surface(), normals, rayBuffer, hitBuffer, transfer, std::uint32_t{1},
             values);
  const std::vector<float> got = values.read();
  Differences differences;
  for (std::size_t v = 0; v < voxels; ++v)
    for (std::size_t k = 0; k < width; ++k) {
      const std::size_t column = k % Senders::columns, function = k / Senders::columns % sentBands,
                        channel = k / Senders::columns / sentBands;
      const double greatest = std::sqrt((2.0 * std::floor(std::sqrt(double(function))) + 1.0) / (4.0 * pi));
      double truth = 0.0, scale = 0.0;
      for (std::size_t j = 0; j < rayCount; ++j) {
        const Ray& ray = rays[v * rayCount + j];
        const double term =
            sentAlong(senders, ray, hits[v * rayCount + j], albedo, channel * Senders::columns + column) /
            rayCount;
        std::array<double, sentBands> bands{};
        sh::evaluate(glm::normalize(glm::dvec3(ray.direction[0], ray.direction[1], ray.direction[2])),
                     sentOrder, bands);
        truth += bands[function] * term;
        scale += greatest * std::abs(term);
      }
      differences.add(got[v * width + k], truth, scale);
    }
  trials.record(stress, differences, sumBound(3.0 * rayCount + 12.0));
}

/// Measures stored hits: the corner that a number selects, and the albedo in ten bits per channel.
void storeSenders(const char* stress, double albedo, Trials& trials) {
  DeviceContext& device = trials.context();
  const Senders known(albedo, 1.0, trials);
  const std::vector<Ray> rays = generate({-1, -1, -1, 0.01f}, 0, trials);
  const std::vector<Hit> hits = someHits(rays.size());
  std::vector<Receiver> receivers(voxels);
  for (std::uint32_t i = 0; i < voxels; ++i) receivers[i].seed = 977u * i;
  const CastParameters parameters{voxels, rayCount, 4, known.scene.vertexCount(), 0, 0.0f, 0.0f, 0.0f};
  const Buffer<CastParameters> parameterBuffer(device, std::span(&parameters, 1));
  const Buffer<Ray> rayBuffer(device, std::span<const Ray>(rays));
  const Buffer<Hit> hitBuffer(device, std::span<const Hit>(hits));
  const Buffer<Receiver> receiverBuffer(device, std::span<const Receiver>(receivers));
  const Buffer<float> normals(device, std::span<const float>(std::vector<float>{0, 1, 0, 0, 1, 0}));
  const Buffer<Sender> senders(device, rays.size());
  Buffer<std::uint8_t> marks(device, 2);
  marks.fill(0);
  launchOnce(device, "cast/transport_kernels.cl", known.tracer.surfaceOptions().define("PRELIGHT_COLUMNS", 1),
             "storeSenders", {rays.size(), 8}, parameterBuffer, known.tracer.scene().layoutBuffer(),
             known.tracer.scene().surface(), normals, receiverBuffer, rayBuffer, hitBuffer, senders, marks);
  const std::vector<Sender> got = senders.read();
  Differences differences;
  for (std::size_t i = 0; i < got.size(); ++i) {
    const bool nothing = hits[i].triangle == PRELIGHT_NO_TRIANGLE || albedo < 0.5 / 1023.0;
    if (nothing) {
      differences.decide(got[i].vertex == PRELIGHT_NO_TRIANGLE);
      continue;
    }
    const bool back = rays[i].direction[1] > 0.0f;
    const glm::uvec3& t = known.scene.triangles[hits[i].triangle];
    const std::uint32_t vertex = got[i].vertex - (back ? known.scene.vertexCount() : 0u);
    differences.decide(vertex == t.x || vertex == t.y || vertex == t.z);
    for (int c = 0; c < 3; ++c) differences.add((got[i].albedo >> (10 * c) & 1023u) / 1023.0, albedo, 1.0);
  }
  trials.record(stress, differences, 0.5 / 1023.0 + 4.0 * unitRoundoff, {"albedo", albedo});
}

}  // namespace

void runVolume(Trials& trials) {
  volumeRays("a grid of 1 m", {-1.0f, -1.0f, -1.0f, 0.01f}, 0, trials);
  volumeRays("a grid of 1e-6 m", {-1e-6f, -1e-6f, -1e-6f, 1e-8f}, 0, trials);
  volumeRays("a grid of 1e6 m, the last voxels of 512 cubed", {-1e6f, -1e6f, -1e6f, 4e3f},
             512u * 512u * 512u - voxels, trials);
  for (const int order : trials.options().orders)
    if (order <= 16) projectVoxels(order, trials);
  gatherVoxels("albedo 1", 1.0, 1.0, trials);
  gatherVoxels("albedo 0", 0.0, 1.0, trials);
  gatherVoxels("transfer of 1e6", 0.5, 1e6, trials);
  gatherVoxels("denormal transfer", 0.5, 1e-40, trials);
}

void runStoreSenders(Trials& trials) {
  for (const double albedo : {0.0, 1e-6, 0.5, 0.999, 1.0}) storeSenders("hits of both sides", albedo, trials);
}

}  // namespace prelight::benchmarks::stability
