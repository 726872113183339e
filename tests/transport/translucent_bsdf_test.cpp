#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/glm.hpp>
#include <numbers>
#include <random>

#include "transport/bsdf_probe.h"
#include "transport/chi_square.h"

// Scattering to both sides of a translucent surface (kernels/transport/bsdf_funcs.cl).
namespace prelight::test {
namespace {

using std::numbers::pi;

struct Sheet {
  const char* name;
  float diffuse, f0, f90, roughness;
  float transmitted;
};

const std::array sheets{Sheet{"Leaf", 0.0f, 0, 0, 1, 0.8f}, Sheet{"Paper", 0.5f, 0, 0, 1, 0.5f},
                        Sheet{"WaxedPaper", 0.4f, 0.04f, 1, 0.6f, 0.6f},
                        Sheet{"Shade", 0.0f, 0.17f, 1, 1, 1.0f}};

class TranslucentBsdf : public ::testing::TestWithParam<Sheet> {
 protected:
  Probed probe(const std::vector<glm::vec4>& wo, const std::vector<glm::vec4>& wi) const {
    return sheet_.probe(wo, wi);
  }
  std::vector<ProbedSample> sample(const glm::vec4& wo, std::size_t count) const {
    return sheet_.sample(wo, count);
  }

 private:
  static std::vector<float> values() {
    const Sheet& s = GetParam();
    const float layer = s.f90 > 0.0f ? 1.0f : 0.0f;
    return {s.diffuse,     s.diffuse,    s.diffuse, 0,     0,     0,           0,
            s.f0,          s.f0,         s.f0,      s.f90, layer, s.roughness, s.transmitted,
            s.transmitted, s.transmitted};
  }

 protected:
  BsdfProbe sheet_{BuildOptions().define("PRELIGHT_GLOSSY").define("PRELIGHT_TRANSLUCENT"), values()};
};

// Light that passes the sheet one way passes it equally in reverse; the frame of the other side is this one
// upside down.
TEST_P(TranslucentBsdf, Transmission_IsReciprocal) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> unit(0.001, 1.0);
  std::vector<glm::vec4> a, b, aBelow, bBelow;
  for (int i = 0; i < 4000; ++i) {
    a.push_back(directionOf(unit(random), 2 * pi * unit(random)));
    b.push_back(directionOf(unit(random), 2 * pi * unit(random)));
    aBelow.push_back(a.back() * glm::vec4(1, 1, -1, 1));
    bBelow.push_back(b.back() * glm::vec4(1, 1, -1, 1));
  }
  const Probed there = probe(a, bBelow), back = probe(b, aBelow);
  for (std::size_t i = 0; i < a.size(); ++i) {
    const double f = there.total(i) / double(b[i].z), g = back.total(i) / double(a[i].z);
    EXPECT_NEAR(f, g, 2e-4 * (1e-3 + std::abs(f))) << i;
    EXPECT_GT(f, 0.0);
  }
}

// By quadrature over the sphere, the material's share of the body's light is transmitted. All light together
// is no more than arrives, and no less if nothing is absorbed.
TEST_P(TranslucentBsdf, Energy_IsKept) {
  const std::vector<glm::vec4> wi = sphereGrid(800, 64);
  const double cell = 4.0 * pi / static_cast<double>(wi.size());
  const Sheet& s = GetParam();
  const bool lossless = s.diffuse + s.transmitted == 1.0f;
  for (const double cosine : {1.0, 0.8, 0.5, 0.2, 0.05}) {
    const Probed probed = probe(std::vector<glm::vec4>(wi.size(), directionOf(cosine, 0.3)), wi);
    double above = 0.0, below = 0.0;
    for (std::size_t i = 0; i < wi.size(); ++i) (wi[i].z > 0.0f ? above : below) += probed.total(i) * cell;
    double body = 0.0;
    for (std::size_t i = 0; i < wi.size(); ++i) body += double(probed.scattered[2 * i].x) * cell;
    EXPECT_NEAR(below, body * double(s.transmitted) / double(s.diffuse + s.transmitted), 2e-3)
        << "cosine " << cosine;
    EXPECT_LT(above + below, 1.003) << "cosine " << cosine;
    if (lossless) {
      EXPECT_NEAR(above + below, 1.0, 5e-3) << "cosine " << cosine;
    }
    if (s.diffuse == 0.0f && s.f90 == 0.0f) {
      EXPECT_EQ(above, 0.0);
    }
  }
}

TEST_P(TranslucentBsdf, Sampling_FollowsItsDensityOnBothSides) {
  for (const double cosine : {0.95, 0.5, 0.15}) expectSamplesToFollowDensity(sheet_, cosine);
}

INSTANTIATE_TEST_SUITE_P(Sheets, TranslucentBsdf, ::testing::ValuesIn(sheets),
                         [](const auto& test) { return std::string(test.param.name); });

}  // namespace
}  // namespace prelight::test
