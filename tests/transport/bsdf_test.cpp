#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>
#include <random>

#include "benchmarks/lab/lab_kernels.h"
#include "device/context.h"
#include "device/kernel.h"
#include "gpu/light_tables.h"
#include "shared/shade_types.h"
#include "support/devices.h"
#include "transport/bsdf_probe.h"
#include "transport/chi_square.h"

// The kernels' reflection, its samplers and those of the sky, one by one
// (benchmarks/lab/kernels/bsdf_probe_kernels.cl).
namespace prelight::test {
namespace {

using std::numbers::pi;

struct Surface {
  const char* name;
  glm::vec3 diffuse, metal;
  float metalShare;
  glm::vec3 f0;
  float f90, layer, roughness;
};

const std::array surfaces{
    Surface{"lambert", glm::vec3(0.8f), glm::vec3(0), 0, glm::vec3(0), 0, 0, 1},
    Surface{"smooth dielectric", glm::vec3(1), glm::vec3(0), 0, glm::vec3(0.04f), 1, 1, 0.1f},
    Surface{"dielectric", glm::vec3(1), glm::vec3(0), 0, glm::vec3(0.04f), 1, 1, 0.5f},
    Surface{"rough dielectric", glm::vec3(1), glm::vec3(0), 0, glm::vec3(0.17f), 1, 1, 1},
    Surface{"metal", glm::vec3(0), glm::vec3(1), 1, glm::vec3(0), 0, 0, 0.3f},
    Surface{"rough metal", glm::vec3(0), glm::vec3(1), 1, glm::vec3(0), 0, 0, 1},
    Surface{"dark metal", glm::vec3(0), glm::vec3(0.3f), 1, glm::vec3(0), 0, 0, 0.8f},
    Surface{"mixture", glm::vec3(0.5f), glm::vec3(1), 0.5f, glm::vec3(0.04f), 1, 0.5f, 0.65f}};

class Bsdf : public ::testing::TestWithParam<Surface> {
 protected:
  Probed probe(const std::vector<glm::vec4>& wo, const std::vector<glm::vec4>& wi) const {
    return surface_.probe(wo, wi);
  }
  std::vector<ProbedSample> sample(const glm::vec4& wo, std::size_t count) const {
    return surface_.sample(wo, count);
  }

 private:
  static std::vector<float> values() {
    const Surface& s = GetParam();
    return {s.diffuse.x, s.diffuse.y, s.diffuse.z, s.metal.x, s.metal.y, s.metal.z,  s.metalShare,
            s.f0.x,      s.f0.y,      s.f0.z,      s.f90,     s.layer,   s.roughness};
  }

 protected:
  BsdfProbe surface_{BuildOptions().define("PRELIGHT_GLOSSY"), values()};
};

std::vector<glm::vec4> randomHemisphere(std::size_t count, std::uint32_t seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  std::vector<glm::vec4> directions;
  for (std::size_t i = 0; i < count; ++i)
    directions.push_back(directionOf(unit(random) * 0.999 + 0.001, 2 * pi * unit(random)));
  return directions;
}

TEST_P(Bsdf, Reflection_IsReciprocal) {
  const auto a = randomHemisphere(5000, 1), b = randomHemisphere(5000, 2);
  const Probed there = probe(a, b), back = probe(b, a);
  for (std::size_t i = 0; i < a.size(); ++i) {
    const double f = there.total(i) / static_cast<double>(b[i].z),
                 g = back.total(i) / static_cast<double>(a[i].z);
    EXPECT_NEAR(f, g, 2e-4 * (1e-3 + std::abs(f))) << i;
    EXPECT_GE(f, 0.0);
  }
}

// Sampled by the BSDF's own density, so that narrow lobes are found. The table of albedos is interpolated
// with an error of up to 0.3 % (AlbedoTable).
TEST_P(Bsdf, Reflection_NeverExceedsWhatArrives) {
  constexpr std::size_t count = 1 << 16;
  for (const double cosine : {1.0, 0.8, 0.5, 0.2, 0.05}) {
    double sum = 0.0, squares = 0.0;
    for (const ProbedSample& drawn : sample(directionOf(cosine, 0.3), count)) {
      const double weight = double(drawn.weight.x);
      ASSERT_TRUE(std::isfinite(weight));
      sum += weight;
      squares += weight * weight;
    }
    const double mean = sum / count, error = std::sqrt(std::max(squares / count - mean * mean, 0.0) / count);
    EXPECT_LT(mean, 1.003 + 4.0 * error) << "cosine " << cosine;
    EXPECT_GT(mean, 0.2) << "cosine " << cosine;
  }
}

// A sample, the value of its direction and the density of its direction come from three functions, which must
// agree.
TEST_P(Bsdf, Samples_WeighTheirValueByTheirDensity) {
  for (const double cosine : {1.0, 0.5, 0.05}) {
    const glm::vec4 wo = directionOf(cosine, 0.3);
    std::vector<ProbedSample> samples;
    std::vector<glm::vec4> wi;
    for (const ProbedSample& drawn : sample(wo, 4000)) {
      if (!drawn.goesOn()) continue;
      samples.push_back(drawn);
      wi.push_back(drawn.direction);
    }
    ASSERT_GT(samples.size(), 1000u);
    const Probed probed = probe(std::vector<glm::vec4>(wi.size(), wo), wi);
    for (std::size_t i = 0; i < wi.size(); ++i) {
      EXPECT_FLOAT_EQ(samples[i].density, probed.densities[i]);
      EXPECT_NEAR(double(samples[i].weight.x) * double(samples[i].density), probed.total(i),
                  1e-5 * probed.total(i));
    }
  }
}

TEST_P(Bsdf, Sampling_FollowsItsDensity) {
  if (GetParam().roughness < 0.2f) GTEST_SKIP() << "narrower than the quadrature's steps";
  for (const double cosine : {0.95, 0.5, 0.15}) expectSamplesToFollowDensity(surface_, cosine);
}

// A coloured layer dims the body by its most reflective channel, whichever that is: no channel reflects more
// than arrives, and the white body below loses no other light.
TEST(BsdfLayer, Colours_TakeTheirLargestChannelOffTheBody) {
  std::vector<glm::vec4> wi;
  constexpr int rings = 512, sectors = 64;
  for (int r = 0; r < rings; ++r)
    for (int s = 0; s < sectors; ++s)
      wi.push_back(directionOf((r + 0.5) / rings, 2 * pi * (s + 0.5) / sectors));
  const double cell = 2.0 * pi / static_cast<double>(wi.size());
  for (const glm::vec3 f0 :
       {glm::vec3(0.5f, 0.1f, 0.02f), glm::vec3(0.02f, 0.5f, 0.1f), glm::vec3(0.1f, 0.02f, 0.5f)}) {
    const BsdfProbe surface(BuildOptions().define("PRELIGHT_GLOSSY"),
                            {1, 1, 1, 0, 0, 0, 0, f0.x, f0.y, f0.z, 1, 1, 0.7f});
    for (const double cosine : {0.9, 0.3}) {
      const Probed probed = surface.probe(std::vector<glm::vec4>(wi.size(), directionOf(cosine, 0.0)), wi);
      glm::dvec3 sum(0.0);
      for (const glm::vec4& part : probed.scattered) sum += cell * glm::dvec3(part);
      for (int c = 0; c < 3; ++c) {
        EXPECT_LT(sum[c], 1.002) << "cosine " << cosine;
        EXPECT_EQ(probed.scattered[0][c], probed.scattered[0][0]) << "the body";
        if (f0[c] == 0.5f) {
          EXPECT_NEAR(sum[c], 1.0, 4e-3) << "cosine " << cosine;
        }
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Surfaces, Bsdf, ::testing::ValuesIn(surfaces), [](const auto& test) {
  std::string name = test.param.name;
  name.erase(std::remove(name.begin(), name.end(), ' '), name.end());
  return name;
});

/// A surface with every rough lobe, whose shading normal z leans away from its triangle's normal.
class BentNormal : public ::testing::Test {
 protected:
  BsdfProbe importance() const {
    return {BuildOptions()
                .define("PRELIGHT_GLOSSY")
                .define("PRELIGHT_PROBE_BENT")
                .define("PRELIGHT_PROBE_IMPORTANCE"),
            values()};
  }
  BsdfProbe radiance() const {
    return {BuildOptions().define("PRELIGHT_GLOSSY").define("PRELIGHT_PROBE_BENT"), values()};
  }
  static double geometricCosine(const glm::vec4& d) {
    return glm::dot(glm::dvec3(d), glm::dvec3(0.6, 0.0, 0.8));
  }

 private:
  static std::vector<float> values() {
    return {0.5f, 0.5f, 0.5f,  1.0f, 1.0f, 1.0f, 0.5f, 0.04f, 0.04f, 0.04f,
            1.0f, 0.5f, 0.65f, 0.0f, 0.0f, 0.0f, 0.6f, 0.0f,  0.8f};
  }
};

// Veach 1997, eq. 5.14: power that crosses the triangle from a to b equals radiance that crosses it from b to
// a.
TEST_F(BentNormal, Importance_IsTheAdjointOfRadiance) {
  const auto a = randomHemisphere(4000, 3), b = randomHemisphere(4000, 4);
  const Probed photons = importance().probe(a, b), eyes = radiance().probe(b, a);
  int seen = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    const double from = geometricCosine(a[i]), to = geometricCosine(b[i]);
    if (from < 0.01 || to < 0.01) continue;
    const double expected = eyes.total(i) * to;
    EXPECT_NEAR(photons.total(i) * from, expected, 1e-4 * (1e-3 + expected)) << i;
    ++seen;
  }
  EXPECT_GT(seen, 2000);
}

TEST_F(BentNormal, ImportanceSamples_WeighTheirValueByTheirDensity) {
  const BsdfProbe surface = importance();
  const glm::vec4 wo = directionOf(0.7, 2.0);
  std::vector<ProbedSample> samples;
  std::vector<glm::vec4> wi;
  for (const ProbedSample& drawn : surface.sample(wo, 4000)) {
    if (!drawn.goesOn()) continue;
    samples.push_back(drawn);
    wi.push_back(drawn.direction);
    EXPECT_GT(geometricCosine(drawn.direction), 0.0) << "through the triangle";
  }
  ASSERT_GT(samples.size(), 2000u);
  const Probed probed = surface.probe(std::vector<glm::vec4>(wi.size(), wo), wi);
  for (std::size_t i = 0; i < wi.size(); ++i)
    EXPECT_NEAR(double(samples[i].weight.x) * double(samples[i].density), probed.total(i),
                1e-5 * probed.total(i));
}

/// A sky with a sun of one texel, a black part and a gradient.
Environment patchySky() {
  Environment sky{32, 16, {}};
  for (int y = 0; y < 16; ++y)
    for (int x = 0; x < 32; ++x)
      sky.radiance.push_back(y > 11 ? glm::vec3(0.0f)
                                    : glm::vec3(0.2f, 0.3f, 0.01f * static_cast<float>(x + y)));
  sky.radiance[5 * 32 + 9] = glm::vec3(400.0f);
  sky.radiance[0] = glm::vec3(20.0f);
  return sky;
}

TEST(SkySampling, Directions_FollowTheirDensityAndIntegrateTheSky) {
  DeviceContext& device = sharedDevice().context();
  const Environment sky = patchySky();
  const CompiledScene empty;
  const auto tables = makeLightTables(empty, {}, &sky, true);
  const device::LightLayout layout = lightLayout(tables, 0.4 * std::numbers::pi);
  constexpr std::size_t count = 1 << 17;
  const Buffer<device::LightLayout> p(device, std::span<const device::LightLayout>(&layout, 1));
  const Buffer<std::uint32_t> table(device, std::span<const std::uint32_t>(tables.tables));
  const Buffer<glm::vec4> texels(device, std::span<const glm::vec4>(tables.sky));
  const Buffer<glm::vec4> directions(device, count), lookups(device, count);
  launchOnce(device, labKernel(device, "bsdf_probe_kernels.cl"), BuildOptions().define("PRELIGHT_SKY"),
             "probeSky", count, p, static_cast<std::uint32_t>(count), table, texels, directions, lookups);

  double sphere = 0.0, blue = 0.0;
  std::size_t unequal = 0;
  const auto found = directions.read(), back = lookups.read();
  for (std::size_t i = 0; i < count; ++i) {
    const double density = static_cast<double>(found[i].w);
    ASSERT_TRUE(density > 0.0 && std::isfinite(density));
    sphere += 1.0 / density;
    blue += static_cast<double>(back[i].z) / density;
    unequal += std::abs(static_cast<double>(back[i].w) - density) > 1e-3 * density;
    EXPECT_NEAR(glm::length(glm::dvec3(found[i])), 1.0, 1e-5);
  }
  EXPECT_LT(unequal, count / 500) << "only at texels' edges may rounding decide";
  // Rows 13 to 15 are black and have black neighbours: almost no sample falls there.
  const double lit = 2.0 * pi * (1.0 - std::cos(13.0 * pi / 16.0));
  EXPECT_NEAR(sphere / count, lit, 5e-3 * lit);
  double expected = 0.0;
  constexpr int fine = 16;
  for (int y = 0; y < 16 * fine; ++y)
    for (int x = 0; x < 32 * fine; ++x) {
      const double u = (x + 0.5) / fine - 0.5, v = (y + 0.5) / fine - 0.5;
      const int x0 = static_cast<int>(std::floor(u)), y0 = static_cast<int>(std::floor(v));
      const auto at = [&](int i, int j) {
        return static_cast<double>(sky.radiance[std::clamp(j, 0, 15) * 32 + (i + 32) % 32].z);
      };
      const double fu = u - x0, fv = v - y0;
      const double value = (1 - fv) * ((1 - fu) * at(x0, y0) + fu * at(x0 + 1, y0)) +
                           fv * ((1 - fu) * at(x0, y0 + 1) + fu * at(x0 + 1, y0 + 1));
      expected += value * 2.0 * pi / (32 * fine) *
                  (std::cos(pi * y / (16 * fine)) - std::cos(pi * (y + 1) / (16 * fine)));
    }
  EXPECT_NEAR(blue / count, expected, 4e-3 * expected);
}

}  // namespace
}  // namespace prelight::test
