#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <glm/glm.hpp>
#include <numbers>

#include "transport/bsdf_probe.h"
#include "transport/chi_square.h"
#include "transport/sampler_checks.h"

// Rough lobes that are wider in one direction than in the other (KHR_materials_anisotropy).
namespace prelight::test {
namespace {

using std::numbers::pi;

struct Brushed {
  const char* name;
  float diffuse, metal, metalShare, roughness, strength;
};

BsdfProbe brushed(const Brushed& s, BuildOptions options = {}) {
  const float layer = s.diffuse > 0.0f ? 1.0f : 0.0f, alpha = s.roughness * s.roughness;
  std::vector<float> values{s.diffuse, s.diffuse, s.diffuse, s.metal, s.metal, s.metal,    s.metalShare,
                            0.04f,     0.04f,     0.04f,     1,       layer,   s.roughness};
  values.resize(30, 0.0f);
  values[18] = 1.0f;
  values[29] = alpha + (1.0f - alpha) * s.strength * s.strength;
  return {options.define("PRELIGHT_GLOSSY").define("PRELIGHT_ANISOTROPY"), values};
}

const std::array brushedSurfaces{
    Brushed{"Weakly", 0, 1, 1, 0.3f, 0.3f},          Brushed{"Strongly", 0, 1, 1, 0.2f, 1.0f},
    Brushed{"Sharp", 0, 1, 1, 0.06f, 0.5f},          Brushed{"Half", 0, 1, 1, 0.5f, 0.6f},
    Brushed{"Rough", 0, 1, 1, 0.8f, 0.9f},           Brushed{"Dielectric", 1, 0, 0, 0.3f, 0.8f},
    Brushed{"SharpDielectric", 1, 0, 0, 0.1f, 0.5f}, Brushed{"WeakDielectric", 1, 0, 0, 0.2f, 0.2f}};

class Anisotropy : public ::testing::TestWithParam<Brushed> {
 protected:
  BsdfProbe surface_ = brushed(GetParam());
};

// Checks every roughness, strength, height and azimuth.
TEST_P(Anisotropy, SurfaceThatAbsorbsNothing_ReflectsAllLight) {
  constexpr std::size_t count = 1 << 17;
  for (const double cosine : {1.0, 0.8, 0.5, 0.25, 0.1})
    for (const double azimuth : {0.0, 0.4, 0.9, 1.3, 0.5 * pi}) {
      double sum = 0.0, squares = 0.0;
      for (const ProbedSample& drawn : surface_.sample(directionOf(cosine, azimuth), count)) {
        sum += double(drawn.weight.x);
        squares += double(drawn.weight.x) * double(drawn.weight.x);
      }
      const double mean = sum / count,
                   noise = std::sqrt(std::max(squares / count - mean * mean, 0.0) / count);
      EXPECT_NEAR(mean, 1.0, 5e-3 + 2.0 * noise) << "cosine " << cosine << " azimuth " << azimuth;
      EXPECT_LT(noise, 2e-3);
    }
}

TEST_P(Anisotropy, Reflection_IsReciprocal) { expectReciprocity(surface_, 3e-4); }

TEST_P(Anisotropy, Samples_WeighTheirValueByTheirDensity) {
  expectSamplesToWeighTheirValue(surface_, 0.9, 1e-4, 2000);
}

TEST_P(Anisotropy, Sampling_FollowsItsDensity) {
  if (GetParam().roughness < 0.2f) GTEST_SKIP() << "too sharp for the grid";
  for (const double cosine : {0.95, 0.5, 0.2}) expectSamplesToFollowDensity(surface_, cosine);
}

// The extension's own formulas, in its notation, for light that leaves at the first bounce.
TEST_P(Anisotropy, ValueOfADarkMetal_IsTheExtensions) {
  Brushed dark = GetParam();
  if (dark.metalShare == 0.0f) GTEST_SKIP() << "of metals";
  dark.metal = 1e-4f;  // Dark, so that later bounces vanish.
  const BsdfProbe surface = brushed(dark);
  const double ab = double(dark.roughness) * double(dark.roughness),
               at = ab + (1.0 - ab) * double(dark.strength) * double(dark.strength);
  const auto [a, b] = directionPairs(2000, 0.5);
  const Probed found = surface.probe(a, b);
  for (std::size_t i = 0; i < a.size(); ++i) {
    const glm::dvec3 v(a[i]), l(b[i]), h = glm::normalize(v + l);
    const double vh = glm::dot(v, h), f = 1e-4 + (1.0 - 1e-4) * std::pow(1.0 - vh, 5.0);
    const glm::dvec3 stretched(ab * h.x, at * h.y, at * ab * h.z);
    const double w2 = at * ab / glm::dot(stretched, stretched), d = at * ab * w2 * w2 / pi;
    const double visible = 0.5 / (l.z * glm::length(glm::dvec3(at * v.x, ab * v.y, v.z)) +
                                  v.z * glm::length(glm::dvec3(at * l.x, ab * l.y, l.z)));
    // Later bounces are proportional to the square of the mean reflectance, 1/21 at most.
    const double expected = f * d * visible * l.z;
    EXPECT_NEAR(found.total(i), expected, 2e-4 * expected + 4e-4 * l.z) << i;
  }
}

INSTANTIATE_TEST_SUITE_P(Surfaces, Anisotropy, ::testing::ValuesIn(brushedSurfaces),
                         [](const auto& test) { return std::string(test.param.name); });

// Without strength the lobe is the isotropic one of that roughness.
TEST(AnisotropyOfNoStrength, IsTheEvenLobe) {
  const Brushed plain{"", 0.5f, 0.8f, 0.5f, 0.4f, 0.0f};
  std::vector<float> values{0.5f, 0.5f, 0.5f, 0.8f, 0.8f, 0.8f, 0.5f, 0.04f, 0.04f, 0.04f, 1, 1, 0.4f};
  const BsdfProbe even{BuildOptions().define("PRELIGHT_GLOSSY"), values};
  const auto [a, b] = directionPairs(1000, 0.02);
  const Probed found = brushed(plain).probe(a, b), expected = even.probe(a, b);
  for (std::size_t i = 0; i < a.size(); ++i)
    EXPECT_NEAR(found.total(i), expected.total(i), 1e-4 * expected.total(i)) << i;
}

}  // namespace
}  // namespace prelight::test
