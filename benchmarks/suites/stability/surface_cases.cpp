#include <algorithm>
#include <array>
#include <cmath>

#include "benchmarks/lab/lab_kernels.h"
#include "benchmarks/suites/stability/cases.h"
#include "device/kernel.h"
#include "gpu/albedo_table.h"
#include "gpu/light_tables.h"
#include "shared/albedo_types.h"
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

/// Interpolates between the entries of makeAlbedoTable() in double precision
/// (kernels/transport/albedo_table_funcs.cl).
class ExactAlbedos {
 public:
  glm::dvec2 of(double cosine, double roughness) const {
    const double column = std::sqrt(cosine) * (cosines - 1), row = std::sqrt(roughness) * (rows - 1);
    const int c = std::min(static_cast<int>(column), cosines - 2),
              r = std::min(static_cast<int>(row), rows - 2);
    const auto at = [&](int dr, int dc) {
      return glm::dvec2(table_[std::size_t((r + dr) * cosines + c + dc)]);
    };
    return glm::mix(glm::mix(at(0, 0), at(0, 1), column - c), glm::mix(at(1, 0), at(1, 1), column - c),
                    row - r);
  }
  glm::dvec2 mean(double roughness) const {
    const double row = std::sqrt(roughness) * (rows - 1);
    const int r = std::min(static_cast<int>(row), rows - 2);
    const auto at = [&](int dr) { return glm::dvec2(table_[std::size_t(rows * cosines + r + dr)]); };
    return glm::mix(at(0), at(1), row - r);
  }
  const std::vector<glm::vec4>& table() const { return table_; }

 private:
  static constexpr int cosines = PRELIGHT_ALBEDO_COSINES, rows = PRELIGHT_ALBEDO_ROUGHNESSES;
  std::vector<glm::vec4> table_ = makeAlbedoTable();
};

/// The formulas of docs/notes/reference.md in double precision.
class ExactSurface {
 public:
  ExactSurface(const Surface& s, double roughness, const ExactAlbedos& albedos)
      : s_(s), roughness_(roughness), a2_(std::pow(roughness, 4.0)), albedos_(&albedos) {
    const glm::dvec2 mean = albedos.mean(roughness);
    missing_ = std::max(1.0 - mean.x - mean.y, 0.0);
    layerLater_ = s.layer > 0.0 ? later(s.f0, s.f90) : 0.0;
    gain_ = 1.0 / passed(mean);
  }

  double diffuse(const glm::dvec3& wo, const glm::dvec3& wi) const {
    return s_.diffuse / pi * wi.z * gain_ * passed(first(wo.z)) * passed(first(wi.z));
  }
  double glossy(const glm::dvec3& wo, const glm::dvec3& wi) const {
    const glm::dvec3 h = glm::normalize(wo + wi);
    const double visibility = 0.5 / (wo.z * lambda(wi.z) + wi.z * lambda(wo.z));
    const double rise = std::pow(std::clamp(1.0 - glm::dot(wo, h), 0.0, 1.0), 5.0);
    const double staying = stays(wo.z) * stays(wi.z) / std::max(missing_, 1e-6);
    return (s_.metal + s_.layer * (s_.f0 + (s_.f90 - s_.f0) * rise)) * distribution(h) * visibility * wi.z +
           laterOfBoth() * staying * wi.z / pi;
  }
  double density(const glm::dvec3& wo, const glm::dvec3& wi) const {
    const glm::dvec2 once = first(wo.z);
    const double later = laterOfBoth() * stays(wo.z);
    const double shine =
        (s_.metal + s_.layer * s_.f0) * once.x + (s_.metal + s_.layer * s_.f90) * once.y + later;
    const double body = s_.diffuse * passed(once);
    if (body + shine == 0.0) return 0.0;
    const double lobe = 0.5 * distribution(glm::normalize(wo + wi)) / (wo.z + lambda(wo.z));
    const double share = shine > 0.0 ? later / shine : 0.0;
    return (body * wi.z / pi + shine * ((1.0 - share) * lobe + share * wi.z / pi)) / (body + shine);
  }

 private:
  glm::dvec2 first(double cosine) const { return albedos_->of(cosine, roughness_); }
  double stays(double cosine) const {
    const glm::dvec2 once = first(cosine);
    return 1.0 - once.x - once.y;
  }
  double later(double f0, double f90) const {
    const double mean = f0 + (f90 - f0) / 21.0;
    return mean * mean * (1.0 - missing_) / (1.0 - mean * missing_);
  }
  double laterOfBoth() const { return s_.metal * later(1.0, 1.0) + s_.layer * layerLater_; }
  double passed(const glm::dvec2& once) const {
    return s_.layer > 0.0 ? 1.0 - (s_.f0 * once.x + s_.f90 * once.y + layerLater_ * (1.0 - once.x - once.y))
                          : 1.0;
  }
  double lambda(double cosine) const { return std::sqrt(a2_ + (1.0 - a2_) * cosine * cosine); }
  double distribution(const glm::dvec3& h) const {
    const double q = h.x * h.x + h.y * h.y + a2_ * h.z * h.z;
    return a2_ / (pi * q * q);
  }

  Surface s_;
  double roughness_, a2_;
  const ExactAlbedos* albedos_;
  double missing_ = 0.0, layerLater_ = 0.0, gain_ = 1.0;
};

struct Pairs {
  std::vector<glm::vec4> out, in;
};

glm::vec3 hemisphere(double cosine, double turn) {
  const double sine = std::sqrt(1.0 - cosine * cosine);
  return {sine * std::cos(turn), sine * std::sin(turn), cosine};
}

/// Returns random pairs, or pairs in which one or both graze; half of them lie next to the mirrored
/// direction.
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

/// Returns the parameters of a surface with a white metal.
std::vector<float> valuesOf(const Surface& s, double alpha) {
  const auto f = [](double x) { return static_cast<float>(x); };
  return {f(s.diffuse), f(s.diffuse), f(s.diffuse),       1, 1, 1, f(s.metal), f(s.f0), f(s.f0), f(s.f0),
          f(s.f90),     f(s.layer),   f(std::sqrt(alpha))};
}

void reflect(const Surface& surface, double alpha, const char* stress, double leastCosine, Trials& trials) {
  DeviceContext& device = trials.context();
  const Pairs pairs = pairsOf(leastCosine, alpha);
  const std::size_t count = pairs.out.size();
  const std::vector<float> values = valuesOf(surface, alpha);
  const Buffer<float> valueBuffer(device, std::span<const float>(values));
  const ExactAlbedos albedos;
  const Buffer<glm::vec4> table(device, std::span<const glm::vec4>(albedos.table()));
  const Buffer<glm::vec4> out(device, std::span<const glm::vec4>(pairs.out)),
      in(device, std::span<const glm::vec4>(pairs.in)), reflections(device, 2 * count);
  const Buffer<float> densities(device, count);
  launchOnce(device, labKernel(device, "bsdf_probe_kernels.cl"), BuildOptions().define("PRELIGHT_GLOSSY"),
             "probeReflection", count, valueBuffer, table, static_cast<std::uint32_t>(count), out, in,
             reflections, densities);
  const std::vector<glm::vec4> got = reflections.read();
  const std::vector<float> density = densities.read();
  const ExactSurface exact({surface.name, surface.diffuse, surface.metal,
                            double(static_cast<float>(surface.f0)), surface.f90, surface.layer},
                           double(static_cast<float>(std::sqrt(alpha))), albedos);
  Differences differences;
  for (std::size_t i = 0; i < count; ++i) {
    const glm::dvec3 wo(pairs.out[i]), wi(pairs.in[i]);
    // 1 - cosine loses its digits for grazing light, so the error is relative to the lobe without it.
    differences.add(got[2 * i].x, exact.diffuse(wo, wi), surface.diffuse * wi.z / pi);
    // Light after the first bounce is a small difference of numbers near 1, so its error is relative to an
    // even lobe.
    const double even = (surface.metal + surface.layer) * wi.z / pi;
    differences.add(got[2 * i + 1].x, exact.glossy(wo, wi), exact.glossy(wo, wi) + even);
    differences.add(density[i], exact.density(wo, wi), exact.density(wo, wi) + even);
  }
  // The half vector has a few roundings, which a lobe of width alpha magnifies by 4 / alpha.
  trials.record(std::string(surface.name) + ", " + stress, differences, (48.0 + 24.0 / alpha) * unitRoundoff,
                {"1 / alpha", 1.0 / alpha});
}

void scatter(const Surface& surface, double alpha, double cosine, Trials& trials) {
  DeviceContext& device = trials.context();
  constexpr std::size_t count = 2000;
  const glm::vec4 wo(hemisphere(cosine, 1.0), 0.0f);
  const std::vector<float> values = valuesOf(surface, alpha);
  const Buffer<float> valueBuffer(device, std::span<const float>(values));
  const ExactAlbedos albedos;
  const Buffer<glm::vec4> table(device, std::span<const glm::vec4>(albedos.table()));
  const Buffer<glm::vec4> out(device, std::span(&wo, 1)), samples(device, 2 * count);
  launchOnce(device, labKernel(device, "bsdf_probe_kernels.cl"), BuildOptions().define("PRELIGHT_GLOSSY"),
             "probeScatter", count, valueBuffer, table, static_cast<std::uint32_t>(count), out, samples);
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
    const double near = 1e-5 * rows;  // next to a border both texels are right
    if (std::abs(x - std::round(x)) < near || std::abs(y - std::round(y)) < near) continue;
    const auto row = static_cast<std::size_t>(y),
               column = std::min(static_cast<std::size_t>(x), static_cast<std::size_t>(2 * rows - 1));
    const double probability =
        intervalProbability(all.subspan(tables.rowTable, static_cast<std::size_t>(rows)), row) *
        intervalProbability(all.subspan(tables.columnTable + row * static_cast<std::size_t>(2 * rows),
                                        static_cast<std::size_t>(2 * rows)),
                            column);
    const double truth = probability * 2.0 * rows * rows / (2.0 * pi * pi * std::sin(pi * uv.y));
    // Next to a pole the angle to it has no more digits than the direction: an error of 2 roundoffs of 1.
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
