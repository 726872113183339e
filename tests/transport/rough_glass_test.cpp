#include <gtest/gtest.h>

#include <cmath>
#include <glm/glm.hpp>
#include <numbers>

#include "gpu/film_table.h"
#include "transport/bsdf_probe.h"
#include "transport/chi_square.h"
#include "transport/sampler_checks.h"

// Microfacets that reflect and refract (kernels/transport/rough_glass_funcs.cl).
namespace prelight::test {
namespace {

using std::numbers::pi;

struct Pane {
  const char* name;
  float roughness, share, eta;
  bool solid;
  float body = 0.0f;  ///< Albedo of the part that is not glass.
  float film = 0.0f;  ///< Film thickness, nm.
};

class RoughGlass : public ::testing::TestWithParam<Pane> {
 protected:
  static BsdfProbe pane(const Pane& p, float eta, BuildOptions options = {}) {
    constexpr float filmIor = 1.8f;
    const float layer = p.body > 0.0f ? 1.0f - p.share : 0.0f;
    GlassSurface glass = glassOfIor(double(std::max(eta, 1.0f / eta)));
    const auto f0 = static_cast<float>(p.film > 0.0f ? glass.f0.x : 0.04);
    std::vector<float> values{p.body, p.body, p.body, 0, 0,     0,           0,
                              f0,     f0,     f0,     1, layer, p.roughness, 0,
                              0,      0,      0,      0, 0,     p.share,     p.solid ? 1.0f : 0.0f,
                              eta};
    options.define("PRELIGHT_GLOSSY").define("PRELIGHT_GLASS").define("PRELIGHT_ROUGH_GLASS");
    if (p.film > 0.0f) {
      options.define("PRELIGHT_FILM").define("PRELIGHT_FILM_GLASS");
      values.resize(34, 0.0f);
      values[30] = 1.0f;
      values[31] = filmIor;
      values[32] = p.film;
      glass.filmShare = 1.0;
      glass.filmIor = double(filmIor);
      glass.filmThickness = double(p.film);
    }
    return {options, values, glass};
  }
  /// Ratio of the most reflective channel to red for facets under a film that reflect from wo to wi. The most
  /// reflective channel decides how much light passes.
  static double mostOverRed(const glm::vec4& wo, const glm::vec4& wi) {
    const Pane& p = GetParam();
    if (!(p.film > 0.0f)) return 1.0;
    const double cosine = glm::dot(glm::dvec3(wo), glm::normalize(glm::dvec3(wo) + glm::dvec3(wi)));
    const double eta = double(p.eta), inner = 1.0 - (1.0 - cosine * cosine) / (eta * eta);
    if (inner <= 0.0) return 1.0;
    const double ior = std::max(eta, 1.0 / eta), f0 = std::pow((ior - 1.0) / (ior + 1.0), 2.0);
    glm::dvec3 r =
        filmReflectance(eta < 1.0 ? std::sqrt(inner) : cosine, 1.0, 1.8, double(p.film), glm::dvec3(f0));
    if (!p.solid) r = 2.0 * r / (1.0 + r);
    return std::max({r.x, r.y, r.z}) / r.x;
  }
  BsdfProbe surface_ = pane(GetParam(), GetParam().eta);
};

// Glass that absorbs nothing passes on all light, within the interpolation error of its tables.
TEST_P(RoughGlass, Energy_IsKept) {
  constexpr std::size_t count = 1 << 16;
  for (const double cosine : {1.0, 0.6, 0.3, 0.1}) {
    const glm::vec4 wo = directionOf(cosine, 0.3);
    double sum = 0.0;
    for (const ProbedSample& drawn : surface_.sample(wo, count)) {
      const bool passes = drawn.direction.z < 0.0f;
      const bool scaled = passes && GetParam().solid && GetParam().body == 0.0f;
      sum += double(drawn.weight.x) * (scaled ? double(GetParam().eta) * double(GetParam().eta) : 1.0) *
             (passes ? 1.0 : mostOverRed(wo, drawn.direction));
    }
    const double mean = sum / count;
    EXPECT_LT(mean, 1.008) << "cosine " << cosine;
    EXPECT_GT(mean, 0.992) << "cosine " << cosine;
  }
}

TEST_P(RoughGlass, Samples_WeighTheirValueByTheirDensity) {
  expectSamplesToWeighTheirValue(surface_, 0.3, 1e-3, 1500);
}

// Power that passes from one side to the other equals the radiance that comes back, over the square of the
// index by which radiance is larger inside. Solid glass compensates for light that stays between microfacets
// in the eye's direction, on whichever side the eye is.
TEST_P(RoughGlass, Importance_IsTheAdjointOfRadianceThatPasses) {
  const Pane& p = GetParam();
  const BsdfProbe photons = pane(p, p.eta, BuildOptions().define("PRELIGHT_PROBE_IMPORTANCE"));
  const BsdfProbe eyes = pane(p, p.solid ? 1.0f / p.eta : p.eta);
  std::vector<glm::vec4> above, below, aboveDown, belowUp;
  for (const glm::vec4& a : sphereGrid(24, 24)) {
    if (a.z < 0.05f) continue;
    for (const double turn : {2.0, 3.0, 3.3}) {
      above.push_back(a);
      const double sine = std::sqrt(1.0 - double(a.z) * double(a.z)) / double(p.eta);
      if (sine > 0.98) {
        above.pop_back();
        continue;
      }
      const double azimuth = std::atan2(double(a.y), double(a.x)) + turn;
      belowUp.push_back(directionOf(std::sqrt(1.0 - sine * sine), azimuth));
      below.push_back(belowUp.back() * glm::vec4(1, 1, -1, 1));
      aboveDown.push_back(a * glm::vec4(1, 1, -1, 1));
    }
  }
  const Probed there = photons.probe(above, below), here = eyes.probe(belowUp, aboveDown);
  double seen = 0.0;
  for (std::size_t i = 0; i < above.size(); ++i) {
    const double f = there.total(i) / double(belowUp[i].z), g = here.total(i) / double(above[i].z);
    seen += f;
    EXPECT_NEAR(f, g, 2e-3 * (1e-2 + std::abs(f))) << i;
  }
  EXPECT_GT(seen, 0.1);
}

TEST_P(RoughGlass, Sampling_FollowsItsDensityOnBothSides) {
  if (GetParam().roughness < 0.4f) GTEST_SKIP() << "narrower than the quadrature's steps";
  for (const double cosine : {0.95, 0.5, 0.2}) expectSamplesToFollowDensity(surface_, cosine);
}

// A body of index 1 has no half vectors to refract about.
TEST(RoughGlassOfIndexOne, Light_PassesStraight) {
  const BsdfProbe body({BuildOptions()
                            .define("PRELIGHT_GLOSSY")
                            .define("PRELIGHT_MIRROR")
                            .define("PRELIGHT_GLASS")
                            .define("PRELIGHT_ROUGH_GLASS")},
                       {0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0.5f, 0, 0, 0, 0, 0, 0, 1, 1, 1},
                       glassOfIor(1.0));
  for (const double cosine : {1.0, 0.5, 0.1}) {
    const glm::vec4 wo = directionOf(cosine, 0.3);
    for (const ProbedSample& drawn : body.sample(wo, 1000)) {
      EXPECT_LT(glm::length(glm::vec3(drawn.direction) + glm::vec3(wo)), 1e-5f);
      EXPECT_NEAR(drawn.weight.x, 1.0f, 1e-5f);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(
    Panes, RoughGlass,
    ::testing::Values(Pane{"Thin", 0.5f, 1, 1.5f, false}, Pane{"RoughThin", 1, 1, 1.5f, false},
                      Pane{"SmoothThin", 0.2f, 1, 1.3f, false}, Pane{"Entering", 0.5f, 1, 1.5f, true},
                      Pane{"Leaving", 0.5f, 1, 1 / 1.5f, true}, Pane{"RoughEntering", 0.9f, 1, 1.33f, true},
                      Pane{"HalfGlass", 0.6f, 0.5f, 1.5f, false, 0.5f},
                      Pane{"FilmedThin", 0.15f, 1, 1.5f, false, 0.0f, 380},
                      Pane{"FilmedEntering", 0.5f, 1, 1.5f, true, 0.0f, 450},
                      Pane{"FilmedLeaving", 0.5f, 1, 1 / 1.5f, true, 0.0f, 450},
                      Pane{"RoughFilmed", 0.9f, 1, 1.33f, true, 0.0f, 250}),
    [](const auto& test) { return std::string(test.param.name); });

}  // namespace
}  // namespace prelight::test
