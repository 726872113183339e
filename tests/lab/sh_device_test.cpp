#include "benchmarks/lab/sh_device.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "basis/ch.h"
#include "basis/quadrature.h"
#include "basis/sh_evaluate.h"
#include "prelight/error.h"
#include "support/devices.h"

namespace prelight {
namespace {

std::vector<glm::vec3> rounded(const std::vector<SphereSample>& samples) {
  std::vector<glm::vec3> out;
  for (const SphereSample& s : samples) out.emplace_back(s.direction);
  return out;
}

double worstGramError(int order) {
  const auto samples = sphereQuadrature(2 * order - 2);
  const auto values = sh::evaluateOnDevice(test::sharedDevice(), rounded(samples), order);
  double worst = 0.0;
  for (int i = 0; i < order * order; ++i) {
    for (int j = 0; j <= i; ++j) {
      double sum = 0.0;
      for (std::size_t d = 0; d < samples.size(); ++d) {
        sum += samples[d].weight * values[i * samples.size() + d] * values[j * samples.size() + d];
      }
      worst = std::max(worst, std::abs(sum - (i == j ? 1.0 : 0.0)));
    }
  }
  return worst;
}

TEST(ShDevice, AllOrders_AreOrthonormalToFloat) {
  for (const int order : {1, 3, 6, 14, sh::maxOrder}) EXPECT_LT(worstGramError(order), 5e-7) << order;
}

TEST(ShDevice, LargestOrder_MatchesTheHost) {
  const auto directions = rounded(sphereQuadrature(40));
  const auto values = sh::evaluateOnDevice(test::sharedDevice(), directions, sh::maxOrder);
  std::vector<double> expected(sh::coefficientCount(sh::maxOrder));
  for (std::size_t d = 0; d < directions.size(); ++d) {
    sh::evaluate(glm::normalize(glm::dvec3(directions[d])), sh::maxOrder, expected);
    for (std::size_t i = 0; i < expected.size(); ++i) {
      EXPECT_NEAR(values[i * directions.size() + d], expected[i], 1e-6) << i;
    }
  }
}

// Every order has its own table. Errors are relative to the greatest value of the band.
TEST(ChDevice, EveryOrder_MatchesTheHostToFloat) {
  const auto directions = rounded(sphereQuadrature(24));
  for (int order = 1; order <= ch::maxOrder; ++order) {
    const auto values = ch::evaluateOnDevice(test::sharedDevice(), directions, order);
    std::vector<double> expected(sh::coefficientCount(order));
    for (std::size_t d = 0; d < directions.size(); ++d) {
      ch::evaluate(glm::normalize(glm::dvec3(directions[d])), order, expected);
      for (std::size_t i = 0; i < expected.size(); ++i) {
        const double band = std::floor(std::sqrt(static_cast<double>(i)));
        EXPECT_NEAR(values[i * directions.size() + d], expected[i],
                    5e-7 * std::sqrt((2.0 * band + 1.0) / 12.566))
            << "order " << order << ", function " << i;
      }
    }
  }
}

TEST(ShDevice, Poles_OnlyZonalTermsRemain) {
  const std::vector<glm::vec3> poles = {{0.0f, 0.0f, 1.0f}, {0.0f, 0.0f, -1.0f}};
  const auto values = sh::evaluateOnDevice(test::sharedDevice(), poles, sh::maxOrder);
  for (int l = 0; l < sh::maxOrder; ++l) {
    for (int m = -l; m <= l; ++m) {
      const double expected = m == 0 ? std::sqrt((2.0 * l + 1.0) / (4.0 * 3.14159265358979)) : 0.0;
      EXPECT_NEAR(values[2 * (l * (l + 1) + m)], expected, 3e-7);
      EXPECT_NEAR(values[2 * (l * (l + 1) + m) + 1], l % 2 == 1 ? -expected : expected, 3e-7);
    }
  }
}

TEST(ShDevice, BadOrders_AreUsageErrors) {
  const std::vector<glm::vec3> directions = {{0.0f, 0.0f, 1.0f}};
  EXPECT_THROW(sh::evaluateOnDevice(test::sharedDevice(), directions, 0), UsageError);
  EXPECT_THROW(sh::evaluateOnDevice(test::sharedDevice(), directions, 33), UsageError);
  EXPECT_THROW(ch::evaluateOnDevice(test::sharedDevice(), directions, 33), UsageError);
  EXPECT_TRUE(sh::evaluateOnDevice(test::sharedDevice(), {}, 3).empty());
}

}  // namespace
}  // namespace prelight
