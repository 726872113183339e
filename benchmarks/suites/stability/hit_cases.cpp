#include <algorithm>
#include <cmath>

#include "basis/cube_map.h"
#include "basis/sh_evaluate.h"
#include "basis/sh_zonal.h"
#include "benchmarks/suites/stability/cases.h"
#include "cast/stored_transport.h"
#include "device/kernel.h"
#include "gpu/tracer.h"
#include "scene/surface/surface_frame.h"
#include "shared/cast_types.h"

// Kernels that process a receiver's rays and hits.
namespace prelight::benchmarks::stability {

namespace {

using device::CastParameters;
using device::Hit;
using device::Ray;
using device::Receiver;
using device::Sender;

/// Rays of receivers and their hits: they hit triangle 0 with the probability `closed`.
struct Cast {
  std::uint32_t receivers = 24;
  std::uint32_t rays = 64;
  float obscurance = 0.0f;
  std::vector<Ray> ray;
  std::vector<Hit> hit;

  Cast(std::uint32_t raysPerReceiver, double reach)
      : rays(raysPerReceiver), obscurance(static_cast<float>(reach)) {
    Random random(41);
    for (std::uint32_t i = 0; i < receivers * rays; ++i) {
      const double closed = double(i / rays) / (receivers - 1);
      glm::vec3 d(random.direction());
      if (i % 61 == 0) d = {0.0f, 1e-40f, i % 2 == 0 ? 1.0f : -1.0f};
      if (i % 67 == 0) d = {-1.0f, -0.0f, 1e-20f};
      ray.push_back({{0, 0, 0}, PRELIGHT_NO_TRIANGLE, {d.x, d.y, d.z}, 1e30f});
      const std::uint32_t triangle = random.unit() < closed ? 0u : PRELIGHT_NO_TRIANGLE;
      hit.push_back({triangle == 0 ? static_cast<float>(reach * random.between(0.0, 1.2)) : 0.0f, triangle,
                     0.25f, 0.5f});
    }
  }

  double open(std::size_t i) const {
    if (hit[i].triangle == PRELIGHT_NO_TRIANGLE) return 1.0;
    return obscurance > 0.0f ? std::min(double(hit[i].t) / double(obscurance), 1.0) : 0.0;
  }

  CastParameters parameters(std::uint32_t valueCount, std::uint32_t vertexCount) const {
    return {receivers, rays, valueCount, vertexCount, 0, 0.0f, 0.0f, obscurance};
  }
};

double bandScale(std::size_t i) {
  return std::sqrt((2.0 * std::floor(std::sqrt(double(i) + 0.5)) + 1.0) / (4.0 * pi));
}

/// Means of (V - k) x direction and (V - k) x Y over a receiver's rays, and of |V - k|, where V of ray i is
/// share(i) and k its mean.
struct Projected {
  double mean = 0.0, magnitude = 0.0;
  glm::dvec3 direction{0.0};
  std::vector<double> sh;

  template <class Share>
  Projected(const Cast& cast, std::size_t receiver, int order, const Share& share)
      : sh(static_cast<std::size_t>(order * order), 0.0) {
    const std::size_t first = receiver * cast.rays;
    std::vector<double> y(std::max<std::size_t>(1, sh.size()));
    for (std::size_t j = 0; j < cast.rays; ++j) mean += share(first + j) / cast.rays;
    for (std::size_t j = 0; j < cast.rays; ++j) {
      const Ray& ray = cast.ray[first + j];
      const glm::dvec3 d(ray.direction[0], ray.direction[1], ray.direction[2]);
      const double weight = (share(first + j) - mean) / cast.rays;
      magnitude += std::abs(weight);
      direction += weight * d;
      if (order == 0) continue;
      sh::evaluate(glm::normalize(d), order, y);
      for (std::size_t i = 0; i < sh.size(); ++i) sh[i] += weight * y[i];
    }
  }
};

std::vector<float> project(const Cast& cast, int order, Trials& trials) {
  DeviceContext& device = trials.context();
  const auto n = static_cast<std::uint32_t>(order * order);
  const CastParameters parameters = cast.parameters(4 + n, 0);
  const Buffer<CastParameters> parameterBuffer(device, std::span(&parameters, 1));
  const Buffer<float> table(device, std::span<const float>(makeShTable(std::max(1, order))));
  const Buffer<Ray> rays(device, std::span<const Ray>(cast.ray));
  const Buffer<Hit> hits(device, std::span<const Hit>(cast.hit));
  const Buffer<float> values(device, cast.receivers * (4 + n));
  launchOnce(device, "project/project_kernels.cl", BuildOptions().define("PRELIGHT_SH_ORDER", order),
             "projectHits", {cast.receivers, 8}, parameterBuffer, table, rays, hits, values);
  return values.read();
}

void compareProjection(const char* stress, const Cast& cast, int order, Growth growth, Trials& trials) {
  const std::vector<float> got = project(cast, order, trials);
  const auto n = static_cast<std::size_t>(order * order);
  Differences differences;
  for (std::size_t r = 0; r < cast.receivers; ++r) {
    const Projected truth(cast, r, order, [&](std::size_t i) { return cast.open(i); });
    const float* row = got.data() + r * (4 + n);
    // All weights contain k and its rounding error, so errors are relative to at least k.
    const double scale = std::max(truth.magnitude, truth.mean);
    differences.add(row[0], truth.mean);
    for (int axis = 0; axis < 3; ++axis) differences.add(row[1 + axis], truth.direction[axis], scale);
    for (std::size_t i = 0; i < n; ++i) differences.add(row[4 + i], truth.sh[i], scale * bandScale(i));
  }
  trials.record(stress, differences,
                (cast.rays / 8.0 + 8.0 + 8.0 * order) * unitRoundoff + sumBound(cast.rays),
                std::move(growth));
}

/// Returns [receiver][shell][order^2], for receivers that face `normal`.
std::vector<float> projectShells(const Cast& cast, int order, const std::vector<float>& starts,
                                 const glm::vec3& normal, Trials& trials) {
  DeviceContext& device = trials.context();
  const std::size_t shells = starts.size() + 1;
  Receiver facing{};
  for (int axis = 0; axis < 3; ++axis) facing.normal[axis] = normal[axis];
  const std::vector<Receiver> all(cast.receivers, facing);
  std::vector<float> zonal;
  for (int band = 0; band < order; ++band) zonal.push_back(static_cast<float>(sh::clampedCosine(band)));
  const CastParameters parameters = cast.parameters(0, 0);
  const Buffer<CastParameters> parameterBuffer(device, std::span(&parameters, 1));
  const Buffer<float> startBuffer(device, std::span<const float>(starts));
  const Buffer<float> table(device, std::span<const float>(makeShTable(order)));
  const Buffer<Ray> rays(device, std::span<const Ray>(cast.ray));
  const Buffer<Hit> hits(device, std::span<const Hit>(cast.hit));
  const Buffer<float> zonalBuffer(device, std::span<const float>(zonal));
  const Buffer<Receiver> receivers(device, std::span<const Receiver>(all));
  const Buffer<float> values(device, cast.receivers * shells * static_cast<std::size_t>(order * order));
  launchOnce(device, "techniques/near_lamps/shell_kernels.cl",
             BuildOptions()
                 .define("PRELIGHT_SH_ORDER", order)
                 .define("PRELIGHT_RAYS", static_cast<int>(cast.rays))
                 .define("PRELIGHT_SHELLS", static_cast<int>(shells)),
             "projectShells", cast.receivers, parameterBuffer, startBuffer, zonalBuffer, table, receivers,
             rays, hits, values);
  return values.read();
}

/// Compares shells that begin at a fifth, a half and all of `reach`, with hits up to that distance.
void compareShells(const char* stress, double reach, int order, Trials& trials) {
  Cast cast(64, reach);
  cast.obscurance = 0.0f;
  const std::vector<float> starts = {static_cast<float>(0.2 * reach), static_cast<float>(0.5 * reach),
                                     static_cast<float>(reach)};
  const glm::vec3 normal = glm::normalize(glm::vec3(0.3f, -0.7f, 0.5f));
  const std::vector<float> got = projectShells(cast, order, starts, normal, trials);
  const auto n = static_cast<std::size_t>(order * order);
  std::vector<double> open(n);
  sh::openTransfer(glm::dvec3(normal), order, open);
  Differences differences;
  for (std::size_t item = 0; item < cast.receivers * (starts.size() + 1); ++item) {
    const std::size_t receiver = item / (starts.size() + 1), shell = item % (starts.size() + 1);
    const Projected truth(cast, receiver, order, [&](std::size_t i) {
      const bool after = shell == 0 || cast.hit[i].t >= starts[shell - 1];
      const bool before = shell == starts.size() || cast.hit[i].t < starts[shell];
      return after && before ? 1.0 - cast.open(i) : 0.0;
    });
    const float* row = got.data() + item * n;
    const double scale = std::max(truth.magnitude, truth.mean);
    for (std::size_t i = 0; i < n; ++i)
      differences.add(row[i], truth.sh[i] + truth.mean * open[i], scale * bandScale(i));
  }
  trials.record(stress, differences,
                (cast.rays / 8.0 + 8.0 + 8.0 * order) * unitRoundoff + sumBound(cast.rays),
                {"order", double(order)});
}

/// Compares sectors of azimuth around normals. Receivers with a ray on a border between two sectors are left
/// out.
void compareSectors(const char* stress, std::uint32_t raysPerReceiver, std::uint32_t sectors,
                    Trials& trials) {
  DeviceContext& device = trials.context();
  const Cast cast(raysPerReceiver, 1.0);
  Random random(47);
  std::vector<Receiver> receivers(cast.receivers);
  for (Receiver& receiver : receivers) {
    const glm::vec3 n(random.direction());
    std::copy_n(&n.x, 3, receiver.normal);
  }
  const CastParameters parameters = cast.parameters(0, 0);
  const Buffer<CastParameters> parameterBuffer(device, std::span(&parameters, 1));
  const Buffer<Receiver> receiverBuffer(device, std::span<const Receiver>(receivers));
  const Buffer<Ray> rays(device, std::span<const Ray>(cast.ray));
  const Buffer<Hit> hits(device, std::span<const Hit>(cast.hit));
  const std::size_t row = 3 * std::size_t{sectors};
  const Buffer<float> values(device, cast.receivers * row);
  launchOnce(device, "techniques/horizons/sector_kernels.cl", {}, "projectSectors", {cast.receivers, 8},
             parameterBuffer, sectors, receiverBuffer, rays, hits, values);
  const std::vector<float> got = values.read();
  Differences differences;
  for (std::size_t r = 0; r < cast.receivers; ++r) {
    const float* n = receivers[r].normal;
    const glm::dmat3 frame(surfaceFrame({n[0], n[1], n[2]}));
    std::vector<double> truth(row, 0.0);
    double open = 0.0;
    bool certain = true;
    for (std::size_t i = r * cast.rays; i < (r + 1) * cast.rays; ++i) {
      const float* d = cast.ray[i].direction;
      const glm::dvec3 local = glm::dvec3(d[0], d[1], d[2]) * frame;
      const double turn = std::atan2(local.y, local.x) / (2.0 * pi),
                   place = (turn - std::floor(turn)) * sectors;
      certain = certain && std::abs(place - std::round(place)) > 1e-4;
      const std::size_t sector = std::min(static_cast<std::size_t>(place), std::size_t{sectors} - 1);
      const double share = double(sectors) / double(cast.rays), closed = 1.0 - cast.open(i);
      truth[sector] += share * closed;
      truth[sectors + sector] += share * (1.0 - closed);
      truth[2 * std::size_t{sectors} + sector] += share * closed * local.z * local.z;
      open += cast.open(i);
    }
    if (open <= 0.0 || open >= double(cast.rays))  // sectors with the same values
      for (std::size_t s = 0; s < sectors; ++s) {
        truth[s] = 1.0 - open / cast.rays;
        truth[sectors + s] = open / cast.rays;
        truth[2 * std::size_t{sectors} + s] = 0.5 * truth[s];
      }
    for (std::size_t s = 0; certain && s < row; ++s)
      differences.add(got[r * row + s], truth[s], std::max(1.0, double(sectors) / cast.rays));
  }
  trials.record(stress, differences, sumBound(cast.rays), {"sectors", double(sectors)});
}

void gather(const char* stress, double magnitude, bool white, std::uint32_t rayCount, Trials& trials) {
  DeviceContext& device = trials.context();
  const CompiledScene scene = floorScene(1.0, 1, matte(1.0));
  const Tracer tracer(scene, trials.device());
  constexpr std::uint32_t columns = 9, receivers = 30, slots = 8, width = widestPart, firstValue = 10;
  Random random(43);
  std::vector<float> transfer = random.floats(slots * width, magnitude);
  if (white)
    for (float& t : transfer) t = std::abs(t);
  std::vector<Sender> senders(std::size_t{receivers} * rayCount);
  for (Sender& s : senders)
    s = {random.bits() % 5 == 0 ? PRELIGHT_NO_TRIANGLE : random.bits() % slots,
         white ? 0x3fffffffu : random.bits() & 0x3fffffffu};
  const CastParameters parameters{receivers, rayCount, 4 + columns, scene.vertexCount(), 0, 0.0f, 0.0f, 0.0f};
  const Buffer<CastParameters> parameterBuffer(device, std::span(&parameters, 1));
  const Buffer<Sender> senderBuffer(device, std::span<const Sender>(senders));
  const Buffer<float> transferBuffer(device, std::span<const float>(transfer));
  const Buffer<float> values(device, receivers * width);
  launchOnce(
      device, "cast/transport_kernels.cl",
      tracer.surfaceOptions().define("PRELIGHT_COLUMNS", columns).define("PRELIGHT_PART_VALUES", width),
      "gatherBounce", receivers, parameterBuffer, firstValue, std::uint32_t{0}, senderBuffer, transferBuffer,
      values);
  const std::vector<float> got = values.read();
  Differences differences;
  for (std::size_t r = 0; r < receivers; ++r)
    for (std::size_t i = 0; i < width; ++i) {
      const std::size_t c = (firstValue + i) / columns;
      double truth = 0.0, scale = 0.0;
      for (std::size_t j = 0; j < rayCount; ++j) {
        const Sender& s = senders[r * rayCount + j];
        if (s.vertex == PRELIGHT_NO_TRIANGLE) continue;
        const double term =
            (s.albedo >> (10 * c) & 1023u) / 1023.0 * double(transfer[s.vertex * width + i]) / rayCount;
        truth += term;
        scale += std::abs(term);
      }
      differences.add(got[r * width + i], truth, scale);
    }
  trials.record(stress, differences, sumBound(rayCount + 4.0), {"rays", double(rayCount)});
}

void gatherMatrices(const char* stress, double magnitude, int order, Trials& trials) {
  DeviceContext& device = trials.context();
  const CompiledScene scene = floorScene(1.0, 1, matte(1.0));
  const Tracer tracer(scene, trials.device());
  const Cast cast(32, 0.0);
  constexpr std::uint32_t columns = 4, slots = 8;
  const auto n = static_cast<std::size_t>(order * order), width = std::size_t{3} * columns;
  Random random(44);
  const std::vector<float> transfer = random.floats(slots * width, magnitude);
  std::vector<Sender> senders(cast.ray.size());
  for (Sender& s : senders) s = {random.bits() % slots, random.bits() & 0x3fffffffu};
  const CastParameters parameters = cast.parameters(4, scene.vertexCount());
  const Buffer<CastParameters> parameterBuffer(device, std::span(&parameters, 1));
  const Buffer<float> table(device, std::span<const float>(makeShTable(order)));
  const Buffer<Ray> rays(device, std::span<const Ray>(cast.ray));
  const Buffer<Sender> senderBuffer(device, std::span<const Sender>(senders));
  const Buffer<float> transferBuffer(device, std::span<const float>(transfer));
  const Buffer<float> values(device, cast.receivers * n * width);
  launchOnce(
      device, "cast/transport_kernels.cl",
      tracer.surfaceOptions().define("PRELIGHT_COLUMNS", columns).define("PRELIGHT_GLOSSY_ORDER", order),
      "gatherGlossy", {cast.receivers, 8}, parameterBuffer, table, rays, senderBuffer, transferBuffer,
      values);
  const std::vector<float> got = values.read();
  Differences differences;
  std::vector<double> truth(n * width), scale(n * width), y(n);
  for (std::size_t r = 0; r < cast.receivers; ++r) {
    std::fill(truth.begin(), truth.end(), 0.0);
    std::fill(scale.begin(), scale.end(), 0.0);
    for (std::size_t j = 0; j < cast.rays; ++j) {
      const Ray& ray = cast.ray[r * cast.rays + j];
      const Sender& s = senders[r * cast.rays + j];
      sh::evaluate(glm::normalize(glm::dvec3(ray.direction[0], ray.direction[1], ray.direction[2])), order,
                   y);
      for (std::size_t k = 0; k < width; ++k) {
        const double sent = (s.albedo >> (10 * (k / columns)) & 1023u) / 1023.0 *
                            double(transfer[s.vertex * width + k]) / cast.rays;
        for (std::size_t i = 0; i < n; ++i) {
          truth[i * width + k] += y[i] * sent;
          scale[i * width + k] += bandScale(i) * std::abs(sent);
        }
      }
    }
    for (std::size_t i = 0; i < n * width; ++i) differences.add(got[r * n * width + i], truth[i], scale[i]);
  }
  trials.record(stress, differences, sumBound(cast.rays + 4.0) + 8.0 * order * unitRoundoff,
                {"order", double(order)});
}

void codeRays(int faceSize, double length, Trials& trials) {
  DeviceContext& device = trials.context();
  Cast cast(64, 1.0);
  for (Ray& ray : cast.ray)
    for (float& d : ray.direction) d = static_cast<float>(double(d) * length);
  const CastParameters parameters = cast.parameters(4, 0);
  const Buffer<CastParameters> parameterBuffer(device, std::span(&parameters, 1));
  const Buffer<Ray> rays(device, std::span<const Ray>(cast.ray));
  const Buffer<Hit> hits(device, std::span<const Hit>(cast.hit));
  const Buffer<std::uint32_t> codes(device, cast.ray.size());
  launchOnce(device, "techniques/haar/texel_kernels.cl", {}, "codeTexels", {cast.ray.size(), 8},
             parameterBuffer, static_cast<std::uint32_t>(faceSize), rays, hits, codes);
  const std::vector<std::uint32_t> got = codes.read();
  Differences differences;
  for (std::size_t i = 0; i < got.size(); ++i) {
    const glm::dvec3 d(cast.ray[i].direction[0], cast.ray[i].direction[1], cast.ray[i].direction[2]);
    // Next to a border both texels are right.
    bool right = false;
    const double step = 8.0 * unitRoundoff * std::max({std::abs(d.x), std::abs(d.y), std::abs(d.z)});
    for (int k = 0; k < 27 && !right; ++k)
      right = cubeTexel(d + step * glm::dvec3(k % 3 - 1, k / 3 % 3 - 1, k / 9 - 1), faceSize) == got[i] >> 8;
    differences.decide(right);
    differences.add((got[i] & 255u) / 255.0, 1.0 - cast.open(i), 1.0);
  }
  trials.record("directions of length " + std::string(length == 1.0  ? "1"
                                                      : length > 1.0 ? "1e30"
                                                                     : "1e-30"),
                differences, 0.5 / 255.0 + 4.0 * unitRoundoff, {"texels per side", double(faceSize)});
}

void markInside(std::uint32_t quarters, Trials& trials) {
  DeviceContext& device = trials.context();
  const Cast cast(16, 0.0);
  std::vector<Receiver> receivers(cast.receivers);
  Random random(45);
  for (Receiver& r : receivers) {
    const glm::vec3 n(random.direction());
    r = {{0, 0, 0}, 7, {n.x, n.y, n.z}, 0, {n.x, n.y, n.z}, 0};
  }
  const std::vector<float> normals = {1.0f, 0.0f, 0.0f};
  const std::vector<std::uint8_t> hiding = {1};
  std::vector<Ray> rays = cast.ray;
  for (std::size_t i = 0; i < rays.size() / 2; ++i) rays[i].direction[0] = std::abs(rays[i].direction[0]);
  const CastParameters parameters = cast.parameters(4, 0);
  const Buffer<CastParameters> parameterBuffer(device, std::span(&parameters, 1));
  const Buffer<Receiver> receiverBuffer(device, std::span<const Receiver>(receivers));
  const Buffer<Ray> rayBuffer(device, std::span<const Ray>(rays));
  std::vector<Hit> hits = cast.hit;
  for (Hit& hit : hits) hit.triangle = 0;
  const Buffer<Hit> hitBuffer(device, std::span<const Hit>(hits));
  const Buffer<float> normalBuffer(device, std::span<const float>(normals));
  const Buffer<std::uint8_t> hides(device, std::span<const std::uint8_t>(hiding)),
      inside(device, cast.receivers);
  launchOnce(device, "cast/inside_kernels.cl", {}, "markInside", {cast.receivers, 8}, parameterBuffer, 1u,
             quarters, receiverBuffer, rayBuffer, hitBuffer, normalBuffer, hides, inside);
  const std::vector<std::uint8_t> got = inside.read();
  Differences differences;
  for (std::size_t r = 0; r < cast.receivers; ++r) {
    std::size_t leaving = 0, backs = 0;
    bool certain = true;
    for (std::size_t j = 0; j < cast.rays; ++j) {
      const float* d = rays[r * cast.rays + j].direction;
      const float* n = receivers[r].geometricNormal;
      const double up = double(d[0]) * n[0] + double(d[1]) * n[1] + double(d[2]) * n[2];
      certain = certain && std::abs(up) > 1e-6;
      leaving += up > 0.0;
      backs += up > 0.0 && d[0] > 0.0f;
    }
    if (certain) differences.decide(got[r] == (leaving > 0 && 4 * backs >= quarters * leaving ? 1 : 0));
  }
  trials.record(quarters == 4 ? "backs all around, and all but one" : "backs by a quarter", differences, 0.0);
}

}  // namespace

void runProjection(Trials& trials) {
  for (const int order : trials.options().orders) {
    const Growth growth{"order", double(order)};
    compareProjection("blocked and open rays", Cast(64, 0.0), order, growth, trials);
    compareProjection("obscurance of 1e-6 m", Cast(64, 1e-6), order, growth, trials);
    compareProjection("obscurance of 1e30 m", Cast(64, 1e30), order, growth, trials);
    if (order == 0) continue;
    compareShells("shells of distance", 1.0, order, trials);
    compareShells("shells of 1e-6 m", 1e-6, order, trials);
    compareShells("shells of 1e30 m", 1e30, order, trials);
  }
  for (const std::uint32_t sectors : {3u, 8u, 64u}) compareSectors("sectors of azimuth", 64, sectors, trials);
  for (const std::uint32_t rays : {8u, 32u, 128u, 256u})
    compareProjection("more rays", Cast(rays, 1.0), 3, {"rays", double(rays)}, trials);
}

void runGatherBounce(Trials& trials) {
  for (const std::uint32_t rays : {8u, 64u, 256u}) {
    gather("random albedo and transfer", 1.0, false, rays, trials);
    gather("albedo 1, transfer of one sign", 1.0, true, rays, trials);
    gather("transfer of 1e6", 1e6, true, rays, trials);
    gather("transfer of 1e-6", 1e-6, false, rays, trials);
    gather("denormal transfer", 1e-40, false, rays, trials);
  }
  for (const int order : {1, 4, 8}) {
    gatherMatrices("matrices, transfer of 1", 1.0, order, trials);
    gatherMatrices("matrices, transfer of 1e6", 1e6, order, trials);
  }
}

void runTexels(Trials& trials) {
  for (const int size : {4, 64, 1024})
    for (const double length : {1.0, 1e30, 1e-30}) codeRays(size, length, trials);
  for (const std::uint32_t quarters : {4u, 1u}) markInside(quarters, trials);
}

}  // namespace prelight::benchmarks::stability
