#include <algorithm>
#include <array>
#include <cmath>

#include "benchmarks/lab/lab_kernels.h"
#include "benchmarks/stability/cases.h"
#include "benchmarks/stability/shapes.h"
#include "device/launch_once.h"
#include "gpu/light_tables.h"
#include "shared/shade_types.h"

// How surfaces scatter light, and how the sky is sampled: benchmarks/lab/kernels/bsdf_probe_kernels.cl.
namespace prelight::benchmarks::stability {

namespace {

struct Surface {
  const char* name;
  double diffuse, metal, f0, f90, layer;
};

constexpr std::array<Surface, 4> surfaces = {{{"black", 0.0, 0.0, 0.0, 0.0, 0.0},
                                              {"white Lambert", 1.0, 0.0, 0.0, 0.0, 0.0},
                                              {"white dielectric", 1.0, 0.0, 0.04, 1.0, 1.0},
                                              {"white metal", 0.0, 1.0, 0.0, 0.0, 0.0}}};

/// The formulas of docs/reference.md in double precision.
class ExactSurface {
 public:
  ExactSurface(const Surface& s, double alpha) : s_(s), a2_(alpha * alpha) {}

  double schlick(double cosine) const {
    const double k = std::clamp(1.0 - cosine, 0.0, 1.0);
    return s_.f0 + (s_.f90 - s_.f0) * std::pow(k, 5.0);
  }
  double diffuse(const glm::dvec3& wo, const glm::dvec3& wi) const {
    return s_.diffuse / pi * wi.z * (1.0 - schlick(wo.z)) * (1.0 - schlick(wi.z));
  }
  double glossy(const glm::dvec3& wo, const glm::dvec3& wi) const {
    const glm::dvec3 h = glm::normalize(wo + wi);
    const double visibility = 0.5 / (wo.z * lambda(wi.z) + wi.z * lambda(wo.z));
    return (s_.metal + s_.layer * schlick(glm::dot(wo, h))) * distribution(h) * visibility * wi.z;
  }
  double density(const glm::dvec3& wo, const glm::dvec3& wi) const {
    const double body = s_.diffuse * (1.0 - schlick(wo.z)), shine = s_.metal + s_.layer * schlick(wo.z);
    if (body + shine == 0.0) return 0.0;
    const double lobe = 0.5 * distribution(glm::normalize(wo + wi)) / (wo.z + lambda(wo.z));
    return (body * wi.z / pi + shine * lobe) / (body + shine);
  }

 private:
  double lambda(double cosine) const { return std::sqrt(a2_ + (1.0 - a2_) * cosine * cosine); }
  double distribution(const glm::dvec3& h) const {
    const double q = h.x * h.x + h.y * h.y + a2_ * h.z * h.z;
    return a2_ / (pi * q * q);
  }

  Surface s_;
  double a2_;
};

struct Pairs {
  std::vector<glm::vec4> out, in;
};

glm::vec3 hemisphere(double cosine, double turn) {
  const double sine = std::sqrt(1.0 - cosine * cosine);
  return {sine * std::cos(turn), sine * std::sin(turn), cosine};
}

/// Random pairs, or pairs in which one or both graze; half of them next to the mirrored direction.
Pairs pairsOf(double leastCosine, double alpha) {
  Random random(51);
  Pairs pairs;
  for (int i = 0; i < 400; ++i) {
    const double turn = 2.0 * pi * random.unit();
    const double co =
        leastCosine > 0.0 && i % 4 != 1 ? leastCosine * random.between(1.0, 3.0) : random.between(1e-3, 1.0);
    const glm::vec3 wo = i == 0 ? glm::vec3(0, 0, 1) : hemisphere(co, turn);
    glm::vec3 wi = hemisphere(
        leastCosine > 0.0 && i % 4 != 2 ? leastCosine * random.between(1.0, 3.0) : random.between(1e-3, 1.0),
        2.0 * pi * random.unit());
    if (i % 2 == 0)
      wi = glm::vec3(glm::normalize(glm::dvec3(-wo.x, -wo.y, wo.z) +
                                    0.5 * alpha * wo.z * random.unit() * random.direction()));
    if (wi.z <= 0.0f) wi.z = 1e-3f;
    pairs.out.emplace_back(wo, 0.0f);
    pairs.in.emplace_back(wi, 0.0f);
  }
  return pairs;
}

std::vector<float> valuesOf(const Surface& s, double alpha) {
  const auto f = [](double x) { return static_cast<float>(x); };
  return {f(s.diffuse), f(s.diffuse), f(s.diffuse), f(s.metal), f(s.metal), f(s.metal),
          f(s.f0),      f(s.f0),      f(s.f0),      f(s.f90),   f(s.layer), f(alpha)};
}

void reflect(const Surface& surface, double alpha, const char* stress, double leastCosine, Trials& trials) {
  DeviceContext& device = trials.context();
  const Pairs pairs = pairsOf(leastCosine, alpha);
  const std::size_t count = pairs.out.size();
  const std::vector<float> values = valuesOf(surface, alpha);
  const Buffer<float> valueBuffer(device, std::span<const float>(values));
  const Buffer<glm::vec4> out(device, std::span<const glm::vec4>(pairs.out)),
      in(device, std::span<const glm::vec4>(pairs.in)), reflections(device, 2 * count);
  const Buffer<float> densities(device, count);
  launchOnce(device, labKernel(device, "bsdf_probe_kernels.cl"), BuildOptions().define("PRELIGHT_GLOSSY"),
             "probeReflection", count, valueBuffer, static_cast<std::uint32_t>(count), out, in, reflections,
             densities);
  const std::vector<glm::vec4> got = reflections.read();
  const std::vector<float> density = densities.read();
  const ExactSurface exact({surface.name, surface.diffuse, surface.metal,
                            double(static_cast<float>(surface.f0)), surface.f90, surface.layer},
                           double(static_cast<float>(alpha)));
  Differences differences;
  for (std::size_t i = 0; i < count; ++i) {
    const glm::dvec3 wo(pairs.out[i]), wi(pairs.in[i]);
    // 1 - cosine has lost its digits where light grazes next to the horizon: relative to the lobe without it.
    differences.add(got[2 * i].x, exact.diffuse(wo, wi), surface.diffuse * wi.z / pi);
    differences.add(got[2 * i + 1].x, exact.glossy(wo, wi));
    differences.add(density[i], exact.density(wo, wi));
  }
  // The half vector is off by a few roundings, which a lobe of width alpha magnifies by 4 / alpha.
  trials.record(std::string(surface.name) + ", " + stress, differences, (48.0 + 24.0 / alpha) * unitRoundoff,
                {"1 / alpha", 1.0 / alpha});
}

void scatter(const Surface& surface, double alpha, double cosine, Trials& trials) {
  DeviceContext& device = trials.context();
  constexpr std::size_t count = 2000;
  const glm::vec4 wo(hemisphere(cosine, 1.0), 0.0f);
  const std::vector<float> values = valuesOf(surface, alpha);
  const Buffer<float> valueBuffer(device, std::span<const float>(values));
  const Buffer<glm::vec4> out(device, std::span(&wo, 1)), samples(device, 2 * count);
  launchOnce(device, labKernel(device, "bsdf_probe_kernels.cl"), BuildOptions().define("PRELIGHT_GLOSSY"),
             "probeScatter", count, valueBuffer, static_cast<std::uint32_t>(count), out, samples);
  Differences differences;
  const std::vector<glm::vec4> drawn = samples.read();
  for (std::size_t i = 0; i < count; ++i)
    if (drawn[2 * i].w > 0.0f) differences.add(glm::length(glm::dvec3(drawn[2 * i])), 1.0);
  trials.record(std::string(surface.name) + ", lengths of drawn directions, cosine of the view " +
                    (cosine < 1e-3 ? "1e-6" : "0.7"),
                differences, 16.0 * unitRoundoff, {"1 / alpha", 1.0 / alpha});
}

void sampleSky(const char* stress, bool sun, double even, int rows, Trials& trials) {
  DeviceContext& device = trials.context();
  Environment sky{
      2 * rows, rows,
      std::vector<glm::vec3>(static_cast<std::size_t>(2 * rows * rows), glm::vec3(static_cast<float>(even)))};
  if (sun) sky.radiance[static_cast<std::size_t>(rows * rows + rows / 2)] = glm::vec3(1e6f);
  const CompiledScene scene = floorScene(1.0, 1, matte(0.5));
  const LightTables tables = makeLightTables(scene, {}, &sky, true);
  const device::LightLayout layout = lightLayout(tables, 0.0);
  constexpr std::size_t count = 4000;
  const Buffer<device::LightLayout> parameters(device, std::span(&layout, 1));
  const Buffer<std::uint32_t> tableBuffer(device, std::span<const std::uint32_t>(tables.tables));
  const Buffer<glm::vec4> texels(device, std::span<const glm::vec4>(tables.sky)), directions(device, count),
      lookups(device, count);
  launchOnce(device, labKernel(device, "bsdf_probe_kernels.cl"), BuildOptions().define("PRELIGHT_SKY"),
             "probeSky", count, parameters, static_cast<std::uint32_t>(count), tableBuffer, texels,
             directions, lookups);
  const std::vector<glm::vec4> drawn = directions.read(), found = lookups.read();
  const std::span<const std::uint32_t> all(tables.tables);
  Differences differences;
  for (std::size_t i = 0; i < count; ++i) {
    const glm::dvec3 d(drawn[i]);
    differences.add(glm::length(d), 1.0);
    const glm::dvec2 uv = Environment::coordinates(glm::normalize(d));
    const double x = uv.x * 2 * rows, y = uv.y * rows;
    const double near = 1e-5 * rows;  // of a border either texel is right
    if (std::abs(x - std::round(x)) < near || std::abs(y - std::round(y)) < near) continue;
    const auto row = static_cast<std::size_t>(y),
               column = std::min(static_cast<std::size_t>(x), static_cast<std::size_t>(2 * rows - 1));
    const double probability =
        intervalProbability(all.subspan(tables.rowTable, static_cast<std::size_t>(rows)), row) *
        intervalProbability(all.subspan(tables.columnTable + row * static_cast<std::size_t>(2 * rows),
                                        static_cast<std::size_t>(2 * rows)),
                            column);
    const double truth = probability * 2.0 * rows * rows / (2.0 * pi * pi * std::sin(pi * uv.y));
    // Next to a pole the angle to it has no more digits than the direction: off by 2 roundoffs of 1.
    const double slack = 1.0 / std::max(std::sin(pi * uv.y), 1e-6);
    differences.add(drawn[i].w, truth, truth * slack);
    differences.add(found[i].w, truth, truth * slack);
  }
  trials.record(stress, differences, 48.0 * unitRoundoff, {"rows of the sky", double(rows)});
}

}  // namespace

void runBsdf(Trials& trials) {
  for (const Surface& surface : surfaces)
    for (const double alpha : {1.0, 0.25, 0.05, 0.0025}) {
      reflect(surface, alpha, "any directions", 0.0, trials);
      reflect(surface, alpha, "cosines of 1e-3", 1e-3, trials);
      reflect(surface, alpha, "cosines of 1e-6", 1e-6, trials);
      if (surface.diffuse + surface.metal > 0.0)
        for (const double cosine : {0.7, 1e-6}) scatter(surface, alpha, cosine, trials);
    }
}

void runSkySampling(Trials& trials) {
  for (const int rows : {2, 64, 512}) {
    sampleSky("an even sky", false, 1.0, rows, trials);
    sampleSky("a sun of 1e6 over 1e-6", true, 1e-6, rows, trials);
    sampleSky("an even sky of 1e-30", false, 1e-30, rows, trials);
  }
}

}  // namespace prelight::benchmarks::stability
