#include "fit/error_estimate.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <random>

#include "support/resumed.h"
#include "support/scenes.h"

namespace prelight {
namespace {

/// Independent samples of an open fraction of 1/2 with a deviation of 1/10, uniform over one triangle.
std::vector<SampleRecord> noisyRecords(std::size_t count, std::mt19937& random) {
  std::uniform_real_distribution<float> unit(0.0f, 1.0f);
  std::normal_distribution<float> noise(0.5f, 0.1f);
  std::vector<SampleRecord> records;
  for (std::size_t i = 0; i < count; ++i) {
    const float u = std::sqrt(unit(random)), v = unit(random);
    records.push_back(
        {{0, u * (1.0f - v), u * v, 1.0f}, noise(random), static_cast<std::uint32_t>(i % errorGroups)});
  }
  return records;
}

ErrorEstimate estimateOf(const FitMesh& mesh, VertexFit fit, const std::vector<SampleRecord>& records,
                         std::uint64_t receivers, const Progress* progress = nullptr) {
  SampleRecords kept;
  for (const SampleRecord& record : records) kept.add(record);
  for (const SampleRecord& record : records) fit.add(record.sample, std::array{double(record.open) - 1.0});
  const NormalEquations equations = fit.equations(defaultSmoothing);
  const std::vector<float> values = fit.solve(equations);
  return estimateAoError(mesh, {fit, equations, values}, {0.5}, kept, receivers, true,
                         {.progress = progress});
}

/// A fit with almost no smoothing, which would pull values together and lessen the error.
VertexFit unsmoothed(const FitMesh& mesh) {
  VertexFit fit(mesh, 1);
  fit.stiffen(std::vector<double>(mesh.slotCount(), 1e-6));
  return fit;
}

// A linear function has three parameters: fitted to n samples of deviation s it is off by s sqrt(3 / n). The
// test averages trials, because eight groups determine a variance only to a factor of two.
TEST(ErrorEstimate, OneTriangle_IsThatOfALinearFit) {
  constexpr std::size_t samples = 800;
  constexpr int trials = 200;
  const CompiledScene scene = test::sceneOf({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}});
  const FitMesh mesh = makeFitMesh(scene);
  std::mt19937 random(17);
  double variance = 0.0;
  for (int i = 0; i < trials; ++i) {
    const ErrorEstimate estimate = estimateOf(mesh, unsmoothed(mesh), noisyRecords(samples, random), samples);
    variance += estimate.rms * estimate.rms / trials;
  }
  EXPECT_NEAR(variance, 0.01 * 3.0 / samples, 0.15 * 0.01 * 3.0 / samples);
}

TEST(ErrorEstimate, StoppedAgainAndAgain_IsTheSame) {
  const FitMesh mesh = makeFitMesh(test::sceneOf({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}));
  std::mt19937 random(18);
  const std::vector<SampleRecord> records = noisyRecords(200, random);
  const ErrorEstimate whole = estimateOf(mesh, unsmoothed(mesh), records, 200);
  const ErrorEstimate parts = test::inManyRuns(
      [&](Progress& progress) { return estimateOf(mesh, unsmoothed(mesh), records, 200, &progress); });
  EXPECT_EQ(parts.slots, whole.slots);
  EXPECT_EQ(parts.rms, whole.rms);
}

// The estimate depends neither on a triangle's first corner nor on the order of shared vertices.
TEST(ErrorEstimate, TurnedTriangle_HasTheSameError) {
  const CompiledScene scene = test::sceneOf({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}),
                      turned = test::sceneOf({{0, 1, 0}, {0, 0, 0}, {1, 0, 0}}, {{0, 1, 2}});
  std::mt19937 random(18);
  const std::vector<SampleRecord> records = noisyRecords(400, random);
  std::vector<SampleRecord> same = records;
  for (SampleRecord& record : same) {
    const float b0 = 1.0f - record.sample.b1 - record.sample.b2;
    record.sample.b2 = record.sample.b1;
    record.sample.b1 = b0;
  }
  const FitMesh mesh = makeFitMesh(scene), turnedMesh = makeFitMesh(turned);
  const ErrorEstimate a = estimateOf(mesh, VertexFit(mesh, 1), records, 400),
                      b = estimateOf(turnedMesh, VertexFit(turnedMesh, 1), same, 400);
  EXPECT_NEAR(a.rms, b.rms, 1e-4 * a.rms);
  EXPECT_NEAR(a.max, b.max, 1e-4 * a.max);
}

// Receivers without a record reduce the error by the square root of their number.
TEST(ErrorEstimate, MoreReceiversThanRecords_MakeItSmaller) {
  const CompiledScene scene = test::sceneOf({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}});
  const FitMesh mesh = makeFitMesh(scene);
  std::mt19937 random(19);
  const std::vector<SampleRecord> records = noisyRecords(400, random);
  const ErrorEstimate all = estimateOf(mesh, VertexFit(mesh, 1), records, 400),
                      part = estimateOf(mesh, VertexFit(mesh, 1), records, 1600);
  EXPECT_NEAR(part.rms, 0.5 * all.rms, 1e-12);
  EXPECT_NEAR(part.max, 0.5 * all.max, 1e-12);
}

}  // namespace
}  // namespace prelight
