#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <functional>

#include "base/directions.h"
#include "basis/cube_map.h"
#include "basis/sh_products.h"
#include "basis/sh_projection.h"
#include "benchmarks/lab/lab_kernels.h"
#include "benchmarks/suites/stability/cases.h"
#include "compress/small_floats.h"
#include "device/kernel.h"
#include "device/layout.h"
#include "fit/vertex_fit.h"
#include "integrators/film.h"
#include "photon/photon_maps.h"
#include "prelight/error.h"
#include "prelight/transfer.h"
#include "scene/surface/surface_regions.h"
#include "shared/reference_types.h"

// Numbers that are stored, counted and averaged,

// and values such as NaN, which must not reach a kernel: the host refuses them.

namespace prelight::benchmarks::stability {

namespace {

void halves(Trials& trials) {
  Random random(111);
  Differences normal, denormal, decisions;
  for (int i = 0; i < 20000; ++i) {
    const auto value =
        static_cast<float>(std::ldexp(random.between(-1.0, 1.0), static_cast<int>(random.bits() % 40) - 24));
    const double back = fromHalf(toHalf(value));
    if (std::abs(double(value)) >= 65520.0)
      decisions.decide(std::isinf(back));
    else if (std::abs(double(value)) < 0x1p-14)
      denormal.add(back / 0x1p-14, double(value) / 0x1p-14, 1.0);
    else
      normal.add(back, value);
  }
  for (std::uint32_t bits = 0; bits < 0x10000u; ++bits) {
    const float value = fromHalf(static_cast<std::uint16_t>(bits));
    decisions.decide(std::isnan(value) || toHalf(value) == bits);
  }
  trials.record("halves of floats", normal, 0x1p-11);
  trials.record("denormal halves, of 2^-14", denormal, 0x1p-11);
  trials.record("every half there and back; what is beyond 65520 is infinite", decisions, 0.0);
}

/// Measures a film after many passes of one mean followed by some of another: no pass may be lost.
void film(std::uint64_t passes, double mean, const char* stress, Trials& trials) {
  reference::Film film(1, 1);
  film.passes = passes;
  const auto m = double(static_cast<float>(mean));
  film.sums[0] = glm::dvec3(m * double(passes));
  film.means[0] = m;
  constexpr int more = 1000;
  const auto other = static_cast<float>(2.0 * mean);
  for (int i = 0; i < more; ++i) film.add(std::vector<glm::vec4>(1, glm::vec4(other)));
  const double truth = (m * double(passes) + double(other) * more) / double(passes + more);
  Differences differences;
  for (int c = 0; c < 3; ++c) differences.add(film.picture().pixels[0][c], truth);
  const double count = double(passes) + more,
               deviation = double(passes) * more / count * (double(other) - m) * (double(other) - m);
  const double variance = deviation / (count - 1.0) / count;
  differences.add(film.variance()[0], variance);
  trials.record(stress, differences, 16.0 * unitRoundoff, {"passes", double(passes)});
}

void averages(std::uint32_t samples, double spread, const char* stress, Trials& trials) {
  DeviceContext& device = trials.context();
  constexpr std::uint32_t pixels = 16;
  device::ReferenceParameters parameters{};
  parameters.pathCount = pixels * samples;
  parameters.samplesPerPass = samples;
  std::vector<device::PathState> paths(parameters.pathCount);
  Random random(112);
  for (device::PathState& path : paths)
    for (float& value : path.radiance)
      value = static_cast<float>(std::pow(spread, random.between(-1.0, 1.0)));
  const Buffer<device::ReferenceParameters> parameterBuffer(device, std::span(&parameters, 1));
  const Buffer<device::PathState> pathBuffer(device, std::span<const device::PathState>(paths));
  const Buffer<glm::vec4> means(device, pixels);
  launchOnce(device, "integrate/path_ends_kernels.cl", {}, "averageSamples", {pixels, 1}, parameterBuffer,
             pathBuffer, means);
  const std::vector<glm::vec4> got = means.read();
  Differences differences;
  for (std::size_t i = 0; i < pixels; ++i)
    for (int c = 0; c < 3; ++c) {
      double truth = 0.0;
      for (std::size_t s = 0; s < samples; ++s) truth += double(paths[i * samples + s].radiance[c]) / samples;
      differences.add(got[i][c], truth);
    }
  trials.record(stress, differences, 4.0 * unitRoundoff, {"samples", double(samples)});
}

/// Measures sums of whole numbers, which are exact up to those of 10^11 photons.
void tallies(std::uint32_t count, std::int64_t largest, const char* stress, Trials& trials) {
  DeviceContext& device = trials.context();
  constexpr std::uint32_t columns = 6, run = 256;
  std::vector<std::int64_t> all(std::size_t{count} * columns);
  Random random(113);
  for (std::int64_t& tally : all) {
    const auto bits = static_cast<std::int64_t>((std::uint64_t{random.bits()} << 32 | random.bits()) >> 1);
    tally = bits % (largest + 1) * (random.bits() % 3 == 0 ? -1 : 1);
  }
  const std::size_t groups = (count + run - 1) / run;
  const Buffer<std::int64_t> tallyBuffer(device, std::span<const std::int64_t>(all)),
      sums(device, groups * columns);
  launchOnce(device, "photon/scatter_kernels.cl", {}, "sumTallies", groups * columns, std::uint32_t{count},
             std::uint32_t{columns}, std::uint32_t{run}, tallyBuffer, sums);
  const std::vector<std::int64_t> got = sums.read();
  Differences differences;
  for (std::size_t g = 0; g < groups; ++g)
    for (std::size_t c = 0; c < columns; ++c) {
      std::int64_t truth = 0;
      for (std::size_t i = g * run; i < std::min<std::size_t>(count, (g + 1) * run); ++i)
        truth += all[i * columns + c];
      differences.decide(got[g * columns + c] == truth);
    }
  trials.record(stress, differences, 0.0, {"tallies", double(count)});
}

void packed(Trials& trials) {
  DeviceContext& device = trials.context();
  Random random(114);
  std::vector<glm::vec4> directions;
  for (int i = 0; i < 4000; ++i) {
    glm::dvec3 d = random.direction();
    if (i % 4 == 1) d = glm::normalize(d * glm::dvec3(1.0, 1e-7, 1e-20));
    if (i % 4 == 2) d = glm::normalize(glm::dvec3(d.x, d.y, 1e-8 * d.z));
    directions.emplace_back(glm::vec3(d), 0.0f);
  }
  const Buffer<glm::vec4> in(device, std::span<const glm::vec4>(directions)),
      unpacked(device, directions.size());
  const Buffer<std::uint32_t> bits(device, directions.size());
  launchOnce(device, labKernel(device, "direction_probe_kernels.cl"), {}, "probeDirections",
             directions.size(), static_cast<std::uint32_t>(directions.size()), in, bits, unpacked);
  const std::vector<glm::vec4> got = unpacked.read();
  Differences differences;
  for (std::size_t i = 0; i < got.size(); ++i)
    for (int axis = 0; axis < 3; ++axis) differences.add(got[i][axis], directions[i][axis], 1.0);
  trials.record("any directions, along axes and folds", differences, 6.5e-5);
}

void copies(Trials& trials) {
  DeviceContext& device = trials.context();
  std::vector<std::uint32_t> bits;
  for (std::uint32_t i = 0; i < 4096; ++i) bits.push_back(i * 1048583u);
  for (std::uint32_t i = 0; i < 64; ++i)
    bits[i] = i % 4 == 0   ? 0x00000001u + i
              : i % 4 == 1 ? 0x7f800000u
              : i % 4 == 2 ? 0x7fc00001u
                           : 0x80000000u;
  const Buffer<std::uint32_t> in(device, std::span<const std::uint32_t>(bits)), out(device, bits.size());
  launchOnce(device, labKernel(device, "copy_kernels.cl"), {}, "copyLanes", {bits.size() / 16, 1}, in,
             static_cast<std::uint32_t>(bits.size() / 16), out);
  const std::vector<std::uint32_t> got = out.read();
  Differences differences;
  for (std::size_t i = 0; i < bits.size(); ++i) differences.decide(got[i] == bits[i]);
  trials.record("every kind of bits: denormal, infinite, no numbers", differences, 0.0);
}

/// Measures the fit to samples of a linear function on a floor, which is that function.
void fit(const char* stress, double half, double magnitude, int cells, Trials& trials) {
  const CompiledScene scene = floorScene(half, cells, matte(1.0));
  const FitMesh mesh = makeFitMesh(scene);
  VertexFit fit(mesh, 1);
  Random random(115);
  const auto linear = [&](const glm::dvec3& p) {
    return magnitude * (0.3 + 0.5 * p.x / half - 0.2 * p.z / half);
  };
  for (std::uint32_t t = 0; t < scene.triangleCount(); ++t)
    for (int i = 0; i < 6; ++i) {
      const double a = std::sqrt(random.unit()), b = random.unit();
      const SurfaceSample sample{t, static_cast<float>(a * (1.0 - b)), static_cast<float>(a * b), 1.0f};
      const std::array<double, 3> w = cornerWeights(sample);
      glm::dvec3 p(0.0);
      for (int k = 0; k < 3; ++k)
        p += w[static_cast<std::size_t>(k)] * glm::dvec3(scene.positions[scene.triangles[t][k]]);
      const double value = linear(p);
      fit.add(sample, std::span(&value, 1));
    }
  const std::vector<float> got = fit.solve(0.0);
  Differences differences;
  for (std::size_t slot = 0; slot < got.size(); ++slot)
    differences.add(got[slot] / magnitude, linear(glm::dvec3(mesh.positions[slot])) / magnitude, 1.0);
  // The final norm of the residual is 1e-6 of the initial one. One of n values may hold all of it, and the
  // mass matrix has a condition number of about ten.
  trials.record(stress, differences, 1e-5 * std::sqrt(double(got.size())), {"cells per side", double(cells)});
}

}  // namespace

void runStorage(Trials& trials) {
  halves(trials);
  for (const std::uint64_t passes : {std::uint64_t{1}, std::uint64_t{1000000}, std::uint64_t{1000000000}}) {
    film(passes, 1.0, "a picture after many passes", trials);
    film(passes, 1e-6, "a dark picture after many passes", trials);
    film(passes, 1e6, "a bright picture after many passes", trials);
  }
}

void runAverages(Trials& trials) {
  for (const std::uint32_t samples : {1u, 64u, 4096u}) {
    averages(samples, 1.0 + 1e-9, "samples that are all alike", trials);
    averages(samples, 1e6, "samples from 1e-6 to 1e6", trials);
    averages(samples, 1e18, "samples from 1e-18 to 1e18", trials);
  }
}

void runTallies(Trials& trials) {
  for (const std::uint32_t count : {1u, 255u, 65536u}) {
    tallies(count, std::int64_t{1} << 26, "a photon's counts", trials);
    tallies(count, std::int64_t{1} << 53, "256 together reach 2^61", trials);
  }
}

void runPacked(Trials& trials) { packed(trials); }

void runCopies(Trials& trials) {
  copies(trials);
  Differences differences;
  differences.decide(hostLayouts() == deviceLayouts(trials.context()));
  trials.record("layouts of shared structs", differences, 0.0);
}

void runFit(Trials& trials) {
  for (const int cells : {1, 4, 16}) {
    fit("a linear function", 1.0, 1.0, cells, trials);
    fit("a linear function of 1e6", 1.0, 1e6, cells, trials);
    fit("a linear function of 1e-30", 1.0, 1e-30, cells, trials);
    fit("a floor of 1e-6 m", 1e-6, 1.0, cells, trials);
    fit("a floor of 1e6 m", 1e6, 1.0, cells, trials);
  }
}

namespace {

constexpr std::array<float, 3> noNumbers = {NAN, INFINITY, -INFINITY};

bool refuses(const std::function<void()>& work) {
  try {
    work();
  } catch (const Error&) {
    return true;
  }
  return false;
}

void photons(Trials& trials) {
  const CompiledScene scene = floorScene(1.0, 1, matte(1.0));
  const DensitySurface surface = makeDensitySurface(scene, makeSurfaceRegions(scene, usualCreaseAngle));
  Differences differences;
  const auto judge = [&](const device::Photon& photon, bool right) {
    differences.decide(refuses([&] { makePhotonMaps(std::span(&photon, 1), surface); }) != right);
  };
  const device::Photon good{{0, 0, 0}, 0, {1, 1, 1}, 0};
  judge(good, true);
  for (int k = 0; k < 3; ++k) {
    for (const float value : noNumbers) {
      device::Photon bad = good;
      bad.position[k] = value;
      judge(bad, false);
      bad = good;
      bad.power[k] = value;
      judge(bad, false);
    }
    device::Photon bad = good;
    bad.power[k] = -1.0f;
    judge(bad, false);
  }
  device::Photon lost = good;
  lost.triangle = 7;
  judge(lost, false);
  trials.record("photons", differences, 0.0);
}

void lights(Trials& trials) {
  Differences differences;
  for (const float value : {NAN, INFINITY, -INFINITY, -1.0f}) {
    CubeMap map{1, std::vector<glm::vec3>(6, glm::vec3(1.0f))};
    differences.decide(!refuses([&] { checkCubeMap(map, "map"); }));
    map.radiance[3].y = value;
    differences.decide(refuses([&] { checkCubeMap(map, "map"); }));
    Environment sky{4, 2, std::vector<glm::vec3>(8, glm::vec3(1.0f))};
    differences.decide(!refuses([&] { sh::projectEnvironment(sky, 3); }));
    sky.radiance[5].z = value;
    differences.decide(refuses([&] { sh::projectEnvironment(sky, 3); }));
    differences.decide(refuses([&] { cubeFromEnvironment(sky, 4); }));
  }
  trials.record("skies and cube maps", differences, 0.0);
}

void transfer(Trials& trials) {
  Differences differences;
  for (const float value : noNumbers) {
    HarmonicTransfer transfer{2, 1, 0, std::vector<float>(40, 0.5f)};
    for (const char* method : {"half", "band8", "pca:2", "vq:3", "cpca:2:1"}) {
      transfer.coefficients[13] = 0.25f;
      differences.decide(!refuses([&] { compress(transfer, parseCompression(method)); }));
      transfer.coefficients[13] = value;
      differences.decide(refuses([&] { compress(transfer, parseCompression(method)); }));
    }
    std::vector<double> function(9, 1.0);
    function[4] = double(value);
    differences.decide(refuses([&] { sh::productMatrix(function, 3, 2); }));
  }
  trials.record("transfer and coefficients", differences, 0.0);
}

}  // namespace

void runRefusals(Trials& trials) {
  photons(trials);
  lights(trials);
  transfer(trials);
}

}  // namespace prelight::benchmarks::stability
