#include "benchmarks/lab/quincunx.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <vector>

#include "basis/cube_map.h"
#include "prelight/error.h"

namespace prelight {
namespace {

std::vector<double> randomValues(std::size_t count, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  std::vector<double> values(count);
  for (double& value : values) value = uniform(random);
  return values;
}

double mean(const QuincunxLattice& lattice, const std::vector<double>& values) {
  double sum = 0.0;
  for (std::uint32_t i = 0; i < values.size(); ++i) sum += lattice.solidAngle(i) * values[i];
  return sum / (4.0 * std::numbers::pi);
}

TEST(Quincunx, Cells_CoverTheSphereWithThreeOrFourTexels) {
  for (const int intervals : {2, 4, 16}) {
    const QuincunxLattice lattice(intervals);
    EXPECT_EQ(lattice.size(), 6u * intervals * intervals + 2u);
    std::vector<int> texels(lattice.size(), 0);
    std::vector<glm::dvec3> sums(lattice.size(), glm::dvec3(0.0));
    for (std::uint32_t texel = 0; texel < cubeTexelCount(2 * intervals); ++texel) {
      const std::uint32_t point = lattice.pointOf(texel);
      ASSERT_LT(point, lattice.size());
      ++texels[point];
      const glm::dvec3 w = cubeTexelDirection(texel, 2 * intervals);
      sums[point] += w;
      EXPECT_GT(glm::dot(glm::normalize(sums[point]), w), 1.0 - 2.5 / (intervals * intervals))
          << "texels are apart";
    }
    EXPECT_EQ(std::count(texels.begin(), texels.end(), 3), 8);
    EXPECT_EQ(std::count(texels.begin(), texels.end(), 4), static_cast<long>(lattice.size()) - 8);
    double sphere = 0.0;
    for (std::uint32_t i = 0; i < lattice.size(); ++i) sphere += lattice.solidAngle(i);
    EXPECT_NEAR(sphere, 4.0 * std::numbers::pi, 1e-11);
  }
}

TEST(Quincunx, ForwardThenInverse_EverySize_GivesTheValuesBack) {
  for (int intervals = 2; intervals <= 64; intervals *= 2) {
    const QuincunxLattice lattice(intervals);
    const std::vector<double> values = randomValues(lattice.size(), 3);
    std::vector<double> result = values;
    lattice.forward(result);
    lattice.inverse(result);
    for (std::size_t i = 0; i < values.size(); ++i)
      ASSERT_NEAR(result[i], values[i], 1e-13) << intervals << " " << i;
  }
}

TEST(Quincunx, ConstantLight_HasNoDetails) {
  const QuincunxLattice lattice(16);
  std::vector<double> values(lattice.size(), 2.0);
  lattice.forward(values);
  int scaling = 0;
  for (const double value : values) {
    if (std::abs(value - 2.0) < 1e-12) {
      ++scaling;
    } else {
      EXPECT_NEAR(value, 0.0, 1e-13);
    }
  }
  EXPECT_EQ(scaling, 8);
}

TEST(Quincunx, DetailsThatAreDropped_KeepTheMean) {
  const QuincunxLattice lattice(16);
  const std::vector<double> values = randomValues(lattice.size(), 5);
  std::vector<double> ones(lattice.size(), 1.0), coefficients = values;
  lattice.forward(ones);
  lattice.forward(coefficients);
  for (std::size_t i = 0; i < ones.size(); ++i) {
    if (std::abs(ones[i]) < 0.5) coefficients[i] = 0.0;
  }
  lattice.inverse(coefficients);
  EXPECT_NEAR(mean(lattice, coefficients), mean(lattice, values), 1e-12);
}

TEST(Quincunx, TransposedInverse_KeepsSumsOfProducts) {
  for (const int intervals : {2, 8, 32}) {
    const QuincunxLattice lattice(intervals);
    std::vector<double> values = randomValues(lattice.size(), 6), weights = randomValues(lattice.size(), 7);
    double direct = 0.0, transformed = 0.0;
    for (std::size_t i = 0; i < values.size(); ++i) direct += values[i] * weights[i];
    lattice.forward(values);
    lattice.transposedInverse(weights);
    for (std::size_t i = 0; i < values.size(); ++i) transformed += values[i] * weights[i];
    EXPECT_NEAR(transformed, direct, 1e-10) << intervals;
  }
}

TEST(Quincunx, FunctionNorms_GrowWithTheScale) {
  const QuincunxLattice lattice(32);
  const std::vector<double> norms = lattice.functionNorms();
  // Texel 0 lies at a corner of the cube; the point of its neighbour belongs to the finest step.
  const double corner = norms[lattice.pointOf(0)], finest = norms[lattice.pointOf(1)];
  EXPECT_GT(finest, 0.0);
  EXPECT_GT(corner, 10.0 * finest);
}

TEST(Quincunx, BadSizes_AreRefused) {
  for (const int intervals : {-2, 0, 1, 3, 1024})
    EXPECT_THROW(QuincunxLattice{intervals}, UsageError) << intervals;
}

}  // namespace
}  // namespace prelight
