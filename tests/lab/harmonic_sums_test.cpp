#include "benchmarks/lab/harmonic_sums.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

#include "basis/ch.h"
#include "basis/sh_evaluate.h"
#include "support/devices.h"

namespace prelight {
namespace {

std::vector<WeightedDirection> someDirections(std::size_t count) {
  std::mt19937 random(4);
  std::normal_distribution<float> normal;
  std::vector<WeightedDirection> directions(count);
  for (WeightedDirection& d : directions)
    d = {glm::normalize(glm::vec3(normal(random), normal(random), normal(random))), normal(random)};
  return directions;
}

/// Sums over the first block in double, and sums of magnitudes.
struct Truth {
  std::vector<double> sums, magnitudes;

  Truth(const std::vector<WeightedDirection>& directions, bool isCh, int order)
      : sums(static_cast<std::size_t>(order * order)), magnitudes(sums) {
    std::vector<double> values(sums.size());
    for (std::size_t d = 0; d < HarmonicSums::blockSize; ++d) {
      const glm::dvec3 w = glm::normalize(glm::dvec3(directions[d].towards));
      isCh ? ch::evaluate(w, order, values) : sh::evaluate(w, order, values);
      for (std::size_t i = 0; i < values.size(); ++i) {
        sums[i] += directions[d].weight * values[i];
        magnitudes[i] += std::abs(directions[d].weight) * std::sqrt((2.0 * order - 1.0) / 12.566);
      }
    }
  }
};

TEST(HarmonicSums, EveryWay_IsThatOfTheHost) {
  const std::vector<WeightedDirection> directions = someDirections(2 * HarmonicSums::blockSize);
  for (const HarmonicWayName& way : harmonicWays())
    for (const int order : {2, 6}) {
      HarmonicSums device(test::sharedDevice().context(), way.way, order, directions);
      device.run();
      const std::vector<float> got = device.sums();
      const Truth truth(directions, way.isCh, order);
      ASSERT_EQ(got.size(), 2 * truth.sums.size());
      for (std::size_t i = 0; i < truth.sums.size(); ++i)
        EXPECT_NEAR(got[i], truth.sums[i], 2e-6 * truth.magnitudes[i])
            << way.name << ", order " << order << ", function " << i;
    }
}

// A step takes three operations with two constants and two with one; without any, the steps of m = 0 take
// one.
TEST(HarmonicOperations, OfOrderTwo_AreThoseThatArePlainToCount) {
  EXPECT_EQ(harmonicOperations(HarmonicWay::Sh, 2), 4 + 4 + 3);
  EXPECT_EQ(harmonicOperations(HarmonicWay::ChMonic, 2), 4 + 4 + 2);
  EXPECT_EQ(harmonicOperations(HarmonicWay::ChPlain, 2), 4 + 4 + 1 + 1);
  for (int order = 1; order <= 10; ++order)
    EXPECT_EQ(harmonicOperations(HarmonicWay::Ch, order), harmonicOperations(HarmonicWay::Sh, order));
}

}  // namespace
}  // namespace prelight
