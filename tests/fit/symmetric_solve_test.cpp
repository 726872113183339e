#include "fit/symmetric_solve.h"

#include <gtest/gtest.h>

#include <random>

namespace prelight {
namespace {

constexpr std::size_t size = 12;

/// Sum of the outer products of `rank` random vectors, [size][size].
std::vector<double> randomMatrix(std::size_t rank) {
  std::mt19937 random(7);
  std::normal_distribution<double> normal;
  std::vector<double> matrix(size * size, 0.0);
  for (std::size_t r = 0; r < rank; ++r) {
    std::vector<double> v(size);
    for (double& value : v) value = normal(random);
    for (std::size_t i = 0; i < size; ++i)
      for (std::size_t j = 0; j < size; ++j) matrix[i * size + j] += v[i] * v[j];
  }
  return matrix;
}

/// The product matrix x; x and the result are [size][columns].
std::vector<double> product(const std::vector<double>& matrix, const std::vector<double>& x,
                            std::size_t columns) {
  std::vector<double> image(size * columns, 0.0);
  for (std::size_t i = 0; i < size; ++i)
    for (std::size_t j = 0; j < size; ++j)
      for (std::size_t c = 0; c < columns; ++c)
        image[i * columns + c] += matrix[i * size + j] * x[j * columns + c];
  return image;
}

TEST(SymmetricFactors, PositiveDefiniteMatrix_EveryColumnIsSolved) {
  constexpr std::size_t columns = 3;
  const std::vector<double> matrix = randomMatrix(2 * size);
  std::vector<double> wanted(size * columns);
  for (std::size_t i = 0; i < wanted.size(); ++i) wanted[i] = static_cast<double>(i % 7) - 2.5;
  std::vector<double> x = product(matrix, wanted, columns);
  SymmetricFactors(matrix, 0.0).solve(x, columns);
  for (std::size_t i = 0; i < x.size(); ++i) EXPECT_NEAR(x[i], wanted[i], 1e-9);
}

TEST(SymmetricFactors, MissingDirections_SolveWhatHasNothingOfThem) {
  const std::vector<double> matrix = randomMatrix(5);
  const std::vector<double> right = product(matrix, std::vector<double>(size, 1.0), 1);
  std::vector<double> x = right;
  SymmetricFactors(matrix, 1e-12).solve(x, 1);
  const std::vector<double> image = product(matrix, x, 1);
  for (std::size_t i = 0; i < size; ++i) {
    EXPECT_NEAR(image[i], right[i], 1e-9);
    EXPECT_LT(std::abs(x[i]), 100.0);
  }
}

TEST(SymmetricFactors, ZeroMatrix_HasNoSolutionButZero) {
  std::vector<double> x(size, 1.0);
  SymmetricFactors(std::vector<double>(size * size, 0.0), 0.0).solve(x, 1);
  for (const double value : x) EXPECT_EQ(value, 0.0);
}

}  // namespace
}  // namespace prelight
