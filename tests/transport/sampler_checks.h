#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>

#include "transport/bsdf_probe.h"

namespace prelight::test {

/// A sample, the value of its direction and the density of its direction come from three functions, which
/// must agree up to a relative error of `share`. More than `least` samples for each direction must go on.
inline void expectSamplesToWeighTheirValue(const BsdfProbe& surface, double azimuth, double share,
                                           std::size_t least) {
  for (const double cosine : {1.0, 0.5, 0.1}) {
    const glm::vec4 wo = directionOf(cosine, azimuth);
    std::vector<ProbedSample> samples;
    std::vector<glm::vec4> wi;
    for (const ProbedSample& drawn : surface.sample(wo, 4000)) {
      if (!drawn.goesOn()) continue;
      samples.push_back(drawn);
      wi.push_back(drawn.direction);
    }
    ASSERT_GT(samples.size(), least);
    const Probed probed = surface.probe(std::vector<glm::vec4>(wi.size(), wo), wi);
    for (std::size_t i = 0; i < wi.size(); ++i) {
      const double density = double(samples[i].density);
      EXPECT_NEAR(density, double(probed.densities[i]), share * double(probed.densities[i]));
      EXPECT_NEAR(double(samples[i].weight.x) * density, probed.total(i), 2.0 * share * probed.total(i));
    }
  }
}

struct DirectionPairs {
  std::vector<glm::vec4> a, b;
};

/// Pairs of directions above the surface whose cosines fill the range from `least` to 1 evenly.
inline DirectionPairs directionPairs(int count, double least) {
  DirectionPairs pairs;
  for (int i = 0; i < count; ++i) {
    pairs.a.push_back(directionOf(least + (1.0 - least) * std::fmod(i * 0.618034, 1.0), i * 0.7));
    pairs.b.push_back(directionOf(least + (1.0 - least) * std::fmod(i * 0.754878, 1.0), i * 1.9));
  }
  return pairs;
}

/// Scattering from one direction to another equals that in reverse, up to a relative error of `share`, and is
/// never negative.
inline void expectReciprocity(const BsdfProbe& surface, double share) {
  const auto [a, b] = directionPairs(4000, 0.02);
  const Probed there = surface.probe(a, b), back = surface.probe(b, a);
  for (std::size_t i = 0; i < a.size(); ++i) {
    const double f = there.total(i) / double(b[i].z), g = back.total(i) / double(a[i].z);
    EXPECT_NEAR(f, g, share * (1e-3 + std::abs(f))) << i;
    EXPECT_GE(f, 0.0);
  }
}

}  // namespace prelight::test
