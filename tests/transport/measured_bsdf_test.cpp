// Look-up and sampling of measured materials in kernels.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "scene/measured_brdf.h"
#include "support/merl_files.h"
#include "transport/bsdf_probe.h"
#include "transport/chi_square.h"
#include "transport/sampler_checks.h"

namespace prelight::test {
namespace {

using std::numbers::pi;

/// A lobe over a body that is darker at grazing angles.
glm::dvec3 paint(const glm::dvec3& wo, const glm::dvec3& wi) {
  const double edge = std::min({1.0, 5.0 * wo.z, 5.0 * wi.z});
  return ggxBrdf(glm::dvec3(0.4), 0.35)(wo, wi) + glm::dvec3(0.3, 0.4, 0.1) * edge / pi;
}

const MeasuredBrdf& measuredPaint() {
  static const MeasuredBrdf brdf = tabulated(paint);
  return brdf;
}

BsdfProbe probeOf(const MeasuredBrdf& brdf) {
  std::vector<float> values(36, 0.0f);
  for (int c = 0; c < 3; ++c) values[static_cast<std::size_t>(c)] = brdf.diffuse[c];
  values[12] = brdf.roughness;
  BsdfProbe probe(BuildOptions().define("PRELIGHT_GLOSSY").define("PRELIGHT_MEASURED"), values);
  std::vector<float> table;
  for (const auto* part : {&brdf.albedos, &brdf.rest})
    for (const glm::vec3& v : *part) table.insert(table.end(), {v.x, v.y, v.z});
  table.resize((table.size() + 3) / 4 * 4);
  std::vector<glm::vec4> texels;
  for (std::size_t i = 0; i < table.size(); i += 4)
    texels.emplace_back(table[i], table[i + 1], table[i + 2], table[i + 3]);
  probe.set(34, static_cast<float>(probe.append(texels)));
  probe.set(35, brdf.cosineShare);
  return probe;
}

// Both directions stay above the kink of the body's light, which no cell resolves.
TEST(MeasuredBsdf, Value_IsThatOfTheModel) {
  const BsdfProbe probe = probeOf(measuredPaint());
  const auto [wo, wi] = directionPairs(4000, 0.22);
  const Probed probed = probe.probe(wo, wi);
  for (std::size_t i = 0; i < wo.size(); ++i) {
    const double expected = paint(glm::dvec3(wo[i]), glm::dvec3(wi[i])).x * double(wi[i].z);
    EXPECT_NEAR(probed.total(i), expected, 0.02 * expected) << i;
    EXPECT_GE(probed.scattered[2 * i].x, 0.0f);
    EXPECT_GE(probed.scattered[2 * i + 1].x, 0.0f);
  }
}

TEST(MeasuredBsdf, LookUp_IsThatOfDoublePrecision) {
  const MeasuredBrdf& brdf = measuredPaint();
  const auto [wo, wi] = directionPairs(4000, 0.01);
  const Probed probed = probeOf(brdf).probe(wo, wi);
  for (std::size_t i = 0; i < wo.size(); ++i) {
    const double expected =
        (brdfAt(brdf.rest, glm::dvec3(wo[i]), glm::dvec3(wi[i])).x + double(brdf.diffuse.x) / pi) *
        double(wi[i].z);
    EXPECT_NEAR(probed.total(i), expected, 1e-3 * expected + 1e-6) << i;
  }
}

TEST(MeasuredBsdf, Reflection_IsReciprocal) { expectReciprocity(probeOf(measuredPaint()), 1e-3); }

TEST(MeasuredBsdf, Samples_WeighTheirValueByTheirDensity) {
  expectSamplesToWeighTheirValue(probeOf(measuredPaint()), 0.3, 1e-5, 1000);
}

TEST(MeasuredBsdf, Sampling_FollowsItsDensity) {
  const BsdfProbe probe = probeOf(measuredPaint());
  for (const double cosine : {0.95, 0.5, 0.15}) expectSamplesToFollowDensity(probe, cosine);
}

// The mean weight of samples is the model's albedo, and never more than 1.
TEST(MeasuredBsdf, MeanOfTheSamples_IsTheAlbedo) {
  constexpr std::size_t count = 1 << 16;
  const BsdfProbe probe = probeOf(measuredPaint());
  for (const double cosine : {1.0, 0.6, 0.2}) {
    double sum = 0.0, squares = 0.0;
    for (const ProbedSample& drawn : probe.sample(directionOf(cosine, 0.3), count)) {
      sum += double(drawn.weight.x);
      squares += double(drawn.weight.x) * double(drawn.weight.x);
    }
    double expected = 0.0;
    constexpr int steps = 512;
    const glm::dvec3 wo(directionOf(cosine, 0.0));
    for (int i = 0; i < steps; ++i)
      for (int k = 0; k < steps; ++k) {
        const glm::dvec3 wi(directionOf((i + 0.5) / steps, 2.0 * pi * (k + 0.5) / steps));
        expected += paint(wo, wi).x * wi.z * 2.0 * pi / (steps * steps);
      }
    const double mean = sum / count, error = std::sqrt((squares / count - mean * mean) / count);
    EXPECT_NEAR(mean, expected, 0.005 * expected + 4.0 * error) << cosine;
    EXPECT_LT(mean, 1.0);
  }
}

}  // namespace
}  // namespace prelight::test
