#include <gtest/gtest.h>

#include <cmath>
#include <glm/glm.hpp>
#include <numbers>

#include "transport/bsdf_probe.h"
#include "transport/chi_square.h"
#include "transport/sampler_checks.h"

// Clear coats and sheen over other materials (kernels/transport/layer_funcs.cl).
namespace prelight::test {
namespace {

using std::numbers::pi;

struct Layered {
  const char* name;
  float diffuse, metalShare, roughness;
  float coat, coatRoughness;
  glm::vec3 coatNormal;
  float sheen, sheenRoughness;
};

BsdfProbe layered(const Layered& s, BuildOptions options = {}) {
  const float layer = s.diffuse > 0.0f ? 1.0f : 0.0f;
  return {options.define("PRELIGHT_GLOSSY").define("PRELIGHT_MIRROR").define("PRELIGHT_LAYERS"),
          {s.diffuse,
           s.diffuse,
           s.diffuse,
           1,
           1,
           1,
           s.metalShare,
           0.04f,
           0.04f,
           0.04f,
           1,
           layer,
           s.roughness,
           0,
           0,
           0,
           0,
           0,
           1.0f,
           0,
           0,
           1,
           s.coat,
           s.coatRoughness,
           s.coatNormal.x,
           s.coatNormal.y,
           s.coatNormal.z,
           s.sheen,
           s.sheenRoughness}};
}

const glm::vec3 up(0, 0, 1);
const std::array layeredSurfaces{Layered{"CoatedPaint", 1, 0, 0.6f, 1, 0.3f, up, 0, 0.5f},
                                 Layered{"CoatedMetal", 0, 1, 0.4f, 0.8f, 0.5f, up, 0, 0.5f},
                                 Layered{"RoughCoat", 1, 0, 0.9f, 1, 1.0f, up, 0, 0.5f},
                                 Layered{"Velvet", 1, 0, 1.0f, 0, 0.5f, up, 1, 0.5f},
                                 Layered{"SharpVelvet", 1, 0, 1.0f, 0, 0.5f, up, 0.5f, 0.2f},
                                 Layered{"CoatedVelvet", 1, 0, 0.7f, 0.6f, 0.4f, up, 0.7f, 0.8f},
                                 Layered{"BentCoat", 1, 0, 0.6f, 1, 0.4f, {0.3f, 0.1f, 0.9f}, 0, 0.5f}};

class Layers : public ::testing::TestWithParam<Layered> {
 protected:
  BsdfProbe surface_ = layered(GetParam());
};

// Nothing below the layers absorbs: all light comes back within the interpolation error of the albedo tables,
// except light that a coat with another normal sends below the surface.
TEST_P(Layers, OverASurfaceThatAbsorbsNothing_ReflectAllLight) {
  const bool bent = GetParam().coatNormal != up;
  constexpr std::size_t count = 1 << 17;
  for (const double cosine : {1.0, 0.7, 0.4, 0.2, 0.1}) {
    double sum = 0.0, squares = 0.0;
    for (const ProbedSample& drawn : surface_.sample(directionOf(cosine, 0.3), count)) {
      sum += double(drawn.weight.x);
      squares += double(drawn.weight.x) * double(drawn.weight.x);
    }
    const double mean = sum / count, noise = std::sqrt(std::max(squares / count - mean * mean, 0.0) / count);
    EXPECT_LT(noise, 2e-3);
    EXPECT_LT(mean, 1.005 + 3.0 * noise) << "cosine " << cosine;
    EXPECT_GT(mean, (bent ? 0.85 : 0.995) - 3.0 * noise) << "cosine " << cosine;
  }
}

TEST_P(Layers, Samples_WeighTheirValueByTheirDensity) {
  expectSamplesToWeighTheirValue(surface_, 0.3, 1e-4, 2000);
}

// Layers scale the light below by the share that they leave in the eye's direction, on whichever side of the
// path the eye is.
TEST_P(Layers, Importance_IsTheAdjointOfRadiance) {
  const BsdfProbe photons = layered(GetParam(), BuildOptions().define("PRELIGHT_PROBE_IMPORTANCE"));
  const auto [a, b] = directionPairs(3000, 0.02);
  const Probed there = photons.probe(a, b), back = surface_.probe(b, a);
  for (std::size_t i = 0; i < a.size(); ++i) {
    const double expected = back.total(i) * double(b[i].z);
    EXPECT_NEAR(there.total(i) * double(a[i].z), expected, 3e-4 * (1e-3 + expected)) << i;
  }
}

TEST_P(Layers, Sampling_FollowsItsDensity) {
  for (const double cosine : {0.95, 0.5, 0.2}) expectSamplesToFollowDensity(surface_, cosine);
}

INSTANTIATE_TEST_SUITE_P(Surfaces, Layers, ::testing::ValuesIn(layeredSurfaces),
                         [](const auto& test) { return std::string(test.param.name); });

// A smooth coat passes the light that it does not reflect to the body.
TEST(SmoothCoat, OverAWhiteBody_ReflectsAllLight) {
  const BsdfProbe surface = layered({"", 1, 0, 0.8f, 1, 0.0f, up, 0, 0.5f});
  constexpr std::size_t count = 1 << 16;
  for (const double cosine : {1.0, 0.4, 0.1}) {
    double sum = 0.0;
    for (const ProbedSample& drawn : surface.sample(directionOf(cosine, 0.3), count))
      sum += double(drawn.weight.x);
    EXPECT_NEAR(sum / count, 1.0, 6e-3) << "cosine " << cosine;
  }
}

}  // namespace
}  // namespace prelight::test
