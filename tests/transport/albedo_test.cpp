#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/glm.hpp>

#include "gpu/albedo_table.h"
#include "shared/albedo_types.h"
#include "support/ggx_albedo.h"
#include "transport/bsdf_probe.h"

// Albedos of surfaces: the table, and surfaces that absorb nothing.
namespace prelight::test {
namespace {

glm::dvec2 lookedUp(const std::vector<glm::vec4>& table, double cosine, double roughness) {
  constexpr int cosines = PRELIGHT_ALBEDO_COSINES, roughnesses = PRELIGHT_ALBEDO_ROUGHNESSES;
  const double column = std::sqrt(cosine) * (cosines - 1), row = std::sqrt(roughness) * (roughnesses - 1);
  const int c = std::min(int(column), cosines - 2), r = std::min(int(row), roughnesses - 2);
  const auto at = [&](int dr, int dc) { return glm::dvec2(table[(r + dr) * cosines + c + dc]); };
  return glm::mix(glm::mix(at(0, 0), at(0, 1), column - c), glm::mix(at(1, 0), at(1, 1), column - c),
                  row - r);
}

TEST(AlbedoTable, BetweenItsEntries_IsWhatMicrofacetsReflect) {
  const std::vector<glm::vec4> table = makeAlbedoTable();
  for (const double roughness : {0.11, 0.27, 0.48, 0.74, 0.98})
    for (const double cosine : {0.05, 0.11, 0.31, 0.62, 0.93}) {
      const glm::dvec2 expected = reflectedOnce(cosine, roughness, 2000),
                       found = lookedUp(table, cosine, roughness);
      EXPECT_NEAR(found.x, expected.x, 3e-3) << "roughness " << roughness << " cosine " << cosine;
      EXPECT_NEAR(found.y, expected.y, 3e-3) << "roughness " << roughness << " cosine " << cosine;
    }
}

TEST(AlbedoTable, Means_AreThoseOverTheCosine) {
  const std::vector<glm::vec4> table = makeAlbedoTable();
  constexpr int last = PRELIGHT_ALBEDO_ROUGHNESSES - 1, steps = 100000;
  glm::dvec2 sum(0.0);
  for (int i = 0; i < steps; ++i) {
    const double cosine = (i + 0.5) / steps;
    sum += lookedUp(table, cosine, 1.0) * (2.0 * cosine / steps);
  }
  const glm::dvec2 mean(table[PRELIGHT_ALBEDO_ROUGHNESSES * PRELIGHT_ALBEDO_COSINES + last]);
  EXPECT_NEAR(mean.x, sum.x, 1e-5);
  EXPECT_NEAR(mean.y, sum.y, 1e-5);
}

struct Lossless {
  const char* name;
  float diffuse, metalShare, f0, f90, layer;
};

class WhiteFurnace : public ::testing::TestWithParam<Lossless> {};

// The albedo is within half a percent of 1 at every roughness and angle, and never above 1.
TEST_P(WhiteFurnace, SurfaceThatAbsorbsNothing_ReflectsAllLight) {
  const Lossless& s = GetParam();
  constexpr std::size_t count = 1 << 17;
  for (const float roughness : {0.06f, 0.13f, 0.29f, 0.5f, 0.77f, 1.0f}) {
    const BsdfProbe surface(BuildOptions().define("PRELIGHT_GLOSSY"),
                            {s.diffuse, s.diffuse, s.diffuse, 1, 1, 1, s.metalShare, s.f0, s.f0, s.f0, s.f90,
                             s.layer, roughness});
    for (const double cosine : {1.0, 0.7, 0.4, 0.2, 0.1, 0.05}) {
      double sum = 0.0, squares = 0.0;
      for (const ProbedSample& drawn : surface.sample(directionOf(cosine, 0.3), count)) {
        sum += double(drawn.weight.x);
        squares += double(drawn.weight.x) * double(drawn.weight.x);
      }
      const double mean = sum / count,
                   noise = std::sqrt(std::max(squares / count - mean * mean, 0.0) / count);
      EXPECT_NEAR(mean, 1.0, 5e-3) << "roughness " << roughness << " cosine " << cosine << " noise " << noise;
      EXPECT_LT(noise, 2e-3);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Surfaces, WhiteFurnace,
                         ::testing::Values(Lossless{"Metal", 0, 1, 0, 0, 0},
                                           Lossless{"Plastic", 1, 0, 0.04f, 1, 1},
                                           Lossless{"Gem", 1, 0, 0.17f, 1, 1},
                                           Lossless{"WeakLayer", 1, 0, 0.02f, 0.5f, 1},
                                           Lossless{"HalfMetal", 0.5f, 0.5f, 0.04f, 1, 0.5f}),
                         [](const auto& test) { return std::string(test.param.name); });

}  // namespace
}  // namespace prelight::test
