#include "fit/conjugate_gradients.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <random>

#include "fit/vertex_fit.h"
#include "support/resumed.h"
#include "support/scenes.h"

namespace prelight {
namespace {

/// Masses from random samples in every triangle for which `sampled` is true.
template <typename Sampled>
std::vector<TriangleMass> randomMass(const FitMesh& mesh, const Sampled& sampled) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  std::vector<TriangleMass> mass(mesh.triangles.size());
  for (std::size_t t = 0; t < mass.size(); ++t)
    for (int i = 0; i < 3 && sampled(t); ++i) {
      const double a = std::sqrt(unit(random)), b = unit(random);
      const std::array<double, 3> w = {1.0 - a, a * (1.0 - b), a * b};
      for (std::size_t k = 0; k < 3; ++k) {
        mass[t][k] += static_cast<float>(w[k] * w[k]);
        mass[t][3 + k] += static_cast<float>(w[k] * w[(k + 1) % 3]);
      }
    }
  return mass;
}

/// The normal equations by definition: A + lambda L^T S L in double precision. S is the even diagonal; L is a
/// shared vertex's value less the mean of its neighbours' values, weighted by the weight that they share.
Eigen::MatrixXd denseEquations(const FitMesh& mesh, const std::vector<TriangleMass>& mass, double lambda) {
  const Eigen::Index n = mesh.slotCount();
  Eigen::MatrixXd a = Eigen::MatrixXd::Zero(n, n), shared = Eigen::MatrixXd::Zero(n, n);
  Eigen::VectorXd scale = Eigen::VectorXd::Zero(n);
  for (std::size_t t = 0; t < mass.size(); ++t)
    for (std::size_t k = 0; k < 3; ++k) {
      const auto i = mesh.triangles[t][k], j = mesh.triangles[t][(k + 1) % 3];
      a(i, i) += mass[t][k];
      scale[i] += totalWeight(mass[t]) / 6.0;
      a(i, j) += mass[t][3 + k];
      a(j, i) += mass[t][3 + k];
      shared(i, j) += totalWeight(mass[t]);
      shared(j, i) += totalWeight(mass[t]);
    }
  Eigen::MatrixXd laplacian = Eigen::MatrixXd::Identity(n, n);
  for (Eigen::Index i = 0; i < n; ++i) laplacian.row(i) -= shared.row(i) / shared.row(i).sum();
  return a + lambda * laplacian.transpose() * scale.asDiagonal() * laplacian;
}

std::vector<float> randomRight(std::size_t size) {
  std::mt19937 random(6);
  std::uniform_real_distribution<float> unit(-1.0f, 1.0f);
  std::vector<float> right(size);
  for (float& value : right) value = unit(random);
  return right;
}

// Thirteen columns are solved in blocks of 8, 4 and 1.
TEST(ConjugateGradients, EveryColumn_SolvesTheDenseEquations) {
  constexpr std::size_t columns = 13;
  const FitMesh mesh = makeFitMesh(test::sphere(10, 1.0f, {}));
  const std::vector<TriangleMass> mass = randomMass(mesh, [](std::size_t) { return true; });
  const std::vector<float> right = randomRight(mesh.slotCount() * columns);
  std::vector<float> x = right;
  conjugateGradients(NormalEquations(mesh, mass, 0.1), x, columns);
  const Eigen::MatrixXd dense = denseEquations(mesh, mass, 0.1);
  for (std::size_t c = 0; c < columns; ++c) {
    Eigen::VectorXd b(mesh.slotCount());
    for (std::uint32_t s = 0; s < mesh.slotCount(); ++s) b[s] = right[s * columns + c];
    const Eigen::VectorXd expected = dense.ldlt().solve(b);
    for (std::uint32_t s = 0; s < mesh.slotCount(); ++s)
      EXPECT_NEAR(x[s * columns + c], expected[s], 2e-5 * expected.cwiseAbs().maxCoeff());
  }
}

/// The state keeps finished columns, and the iterations of those in progress.
TEST(ConjugateGradients, StoppedAgainAndAgain_GivesTheSameBits) {
  constexpr std::size_t columns = 13;
  const FitMesh mesh = makeFitMesh(test::ground(60, 1.0f));
  const NormalEquations equations(mesh, randomMass(mesh, [](std::size_t) { return true; }), defaultSmoothing);
  const std::vector<float> right = randomRight(mesh.slotCount() * columns);
  for (const bool verified : {true, false}) {
    std::vector<float> whole = right;
    conjugateGradients(equations, whole, columns, {.threads = 3, .verified = verified});
    int runs = 0;
    const std::vector<float> parts = test::inManyRuns([&](Progress& progress) {
      ++runs;
      std::vector<float> values = right;
      conjugateGradients(equations, values, columns,
                         {.threads = 3, .verified = verified, .progress = &progress});
      return values;
    });
    EXPECT_EQ(parts, whole);
    EXPECT_GT(runs, 3);
  }
}

TEST(ConjugateGradients, AnyNumberOfThreads_GivesTheSameBits) {
  constexpr std::size_t columns = 9;
  const FitMesh mesh = makeFitMesh(test::ground(60, 1.0f));
  const std::vector<TriangleMass> mass = randomMass(mesh, [](std::size_t) { return true; });
  const NormalEquations equations(mesh, mass, defaultSmoothing);
  ASSERT_GT(equations.rows(), 3000u) << "several ranges of rows";
  std::vector<float> alone = randomRight(mesh.slotCount() * columns), together = alone;
  conjugateGradients(equations, alone, columns, {.threads = 1});
  conjugateGradients(equations, together, columns, {.threads = 3});
  EXPECT_EQ(alone, together);
}

// The partition of columns into blocks depends on memory, and must not show in the result.
TEST(ConjugateGradients, Column_DoesNotDependOnThoseBesideIt) {
  constexpr std::size_t columns = 13;
  const FitMesh mesh = makeFitMesh(test::ground(40, 1.0f));
  const NormalEquations equations(mesh, randomMass(mesh, [](std::size_t) { return true; }), defaultSmoothing);
  std::vector<float> together = randomRight(mesh.slotCount() * columns);
  // Smooth and rough columns take different numbers of steps.
  for (std::size_t s = 0; s < mesh.slotCount(); ++s)
    for (std::size_t c = 0; c < 6; ++c)
      together[s * columns + c] = mesh.positions[s].x + static_cast<float>(c);
  const std::vector<float> right = together;
  conjugateGradients(equations, together, columns);
  for (std::size_t c = 0; c < columns; ++c) {
    std::vector<float> alone(mesh.slotCount());
    for (std::size_t s = 0; s < alone.size(); ++s) alone[s] = right[s * columns + c];
    conjugateGradients(equations, alone, 1);
    for (std::size_t s = 0; s < alone.size(); ++s) ASSERT_EQ(alone[s], together[s * columns + c]) << c;
  }
}

// Squares of such values exceed the range of single precision.
TEST(ConjugateGradients, TinyAndHugeRightSides_AreSolvedAlike) {
  const FitMesh mesh = makeFitMesh(test::ground(8, 1.0f));
  const NormalEquations equations(mesh, randomMass(mesh, [](std::size_t) { return true; }), defaultSmoothing);
  const std::vector<float> right = randomRight(mesh.slotCount());
  std::vector<float> expected = right;
  conjugateGradients(equations, expected, 1);
  for (const float factor : {0x1p-90f, 0x1p90f}) {
    std::vector<float> x = right;
    for (float& value : x) value *= factor;
    conjugateGradients(equations, x, 1);
    for (std::size_t s = 0; s < x.size(); ++s) EXPECT_EQ(x[s], factor * expected[s]);
  }
}

TEST(ConjugateGradients, SlotsWithoutSamples_KeepWhatTheyHold) {
  const FitMesh mesh = makeFitMesh(test::ground(8, 1.0f));
  const std::vector<TriangleMass> mass =
      randomMass(mesh, [&](std::size_t t) { return t < mesh.triangles.size() / 2; });
  const NormalEquations equations(mesh, mass, defaultSmoothing);
  ASSERT_LT(equations.rows(), mesh.slotCount());
  std::vector<float> x(mesh.slotCount(), 7.0f);
  conjugateGradients(equations, x, 1);
  for (std::uint32_t s = 0; s < mesh.slotCount(); ++s)
    EXPECT_EQ(x[s] == 7.0f, equations.rowOf(s) == NormalEquations::noRow) << s;
}

// Far from samples, values are determined by neighbours alone.
TEST(VertexFit, FarFromSamples_ValuesStayWithinThoseAround) {
  const CompiledScene scene = test::ground(12, 1.0f);
  const FitMesh mesh = makeFitMesh(scene);
  VertexFit fit(mesh, 1);
  for (std::uint32_t t = 0; t < scene.triangleCount(); t += 2)
    if (t < 40 || t > scene.triangleCount() - 40)
      fit.add({t, 0.3f, 0.3f, 1.0f}, std::array{t < 40 ? 1.0 : 3.0});
  float least = 10.0f, most = 0.0f;
  for (const float x : fit.solve(defaultSmoothing)) {
    least = std::min(least, x);
    most = std::max(most, x);
  }
  EXPECT_GT(least, 0.9f);
  EXPECT_LT(most, 3.1f);
}

TEST(VertexFit, ExtentWithoutASlot_LeavesItAtZero) {
  const CompiledScene scene = test::ground(8, 1.0f);
  const FitMesh mesh = makeFitMesh(scene);
  VertexFit fit(mesh, 1);
  fit.add({0, 0.3f, 0.3f, 1.0f}, std::array{2.0});
  EXPECT_NEAR(fit.solve(defaultSmoothing).back(), 2.0, 1e-3);
  std::vector<std::uint8_t> extent(mesh.slotCount(), 0);
  fit.extendTo(extent);
  EXPECT_EQ(fit.solve(defaultSmoothing).back(), 0.0f);
}

// A million samples of one size in a triangle are not lost in their own sum.
TEST(VertexFit, ManySamplesOfOneTriangle_AreAllCounted) {
  const CompiledScene scene = test::sceneOf({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}});
  const FitMesh mesh = makeFitMesh(scene);
  VertexFit fit(mesh, 1);
  std::mt19937 random(7);
  std::uniform_real_distribution<float> unit(0.0f, 1.0f);
  double sum = 0.0;
  std::vector<SurfaceSample> samples;
  std::vector<double> values;
  for (int block = 0; block < 500; ++block) {
    samples.clear();
    values.clear();
    for (int i = 0; i < 4096; ++i) {
      const float a = std::sqrt(unit(random)), b = unit(random);
      samples.push_back({0, a * (1.0f - b), a * b, 1.0f});
      values.push_back(block < 250 ? 0.25 : 0.75);
      sum += 1.0;
    }
    fit.add(samples, values);
  }
  EXPECT_NEAR(fit.weightOf(samples.front()), 1.0, 1e-6);
  for (const float x : fit.solve(0.0)) EXPECT_NEAR(x, 0.5, 5.0 / std::sqrt(sum));
}

}  // namespace
}  // namespace prelight
