#include "fit/normal_equations.h"

#include <gtest/gtest.h>

#include <random>

#include "fit/vertex_fit.h"
#include "receivers/surface_sampler.h"
#include "support/scenes.h"

namespace prelight {
namespace {

/// A fit to samples of a function.
VertexFit sampledFit(const CompiledScene& scene, const FitMesh& mesh,
                     const std::function<double(double, double)>& f) {
  VertexFit fit(mesh, 1);
  SurfaceSampler sampler(scene, 3, Side::Front);
  sampler.pass(40.0 * mesh.slotCount(), 64, [&](const SurfaceSample& s, const device::Receiver& r) {
    const double value = f(r.position[0], r.position[2]);
    fit.add(s, std::span(&value, 1));
  });
  return fit;
}

/// Value at a shared vertex computed from its row and the right-hand side of one sample function.
double throughRow(const CompiledScene& scene, const FitMesh& mesh, const std::vector<SlotWeight>& row,
                  const std::function<double(double, double)>& f) {
  std::vector<double> right(mesh.slotCount(), 0.0);
  SurfaceSampler sampler(scene, 3, Side::Front);
  sampler.pass(40.0 * mesh.slotCount(), 64, [&](const SurfaceSample& s, const device::Receiver& r) {
    const double b[3] = {1.0 - double(s.b1) - double(s.b2), s.b1, s.b2};
    for (std::size_t k = 0; k < 3; ++k)
      right[mesh.triangles[s.triangle][k]] += s.weight * b[k] * f(r.position[0], r.position[2]);
  });
  double sum = 0.0;
  for (const SlotWeight& w : row) sum += w.weight * right[w.slot];
  return sum;
}

TEST(NormalEquations, InverseRow_KeepsConstants) {
  const CompiledScene scene = test::ground(8, 1.0f);
  const FitMesh mesh = makeFitMesh(scene);
  const auto constant = [](double, double) { return 3.0; };
  const NormalEquations equations = sampledFit(scene, mesh, constant).equations(defaultSmoothing);
  for (std::uint32_t slot = 0; slot < mesh.slotCount(); ++slot)
    EXPECT_NEAR(throughRow(scene, mesh, equations.inverseRow(slot), constant), 3.0, 1e-6);
}

// Two rings reach the whole mesh, so that nothing is cut off. Without smoothing the solution is exact.
TEST(NormalEquations, InverseRowOfASmallMesh_IsTheWholeSolution) {
  const CompiledScene scene = test::ground(2, 1.0f);
  const FitMesh mesh = makeFitMesh(scene);
  const auto f = [](double x, double z) { return std::sin(3.0 * x) + x * z; };
  const VertexFit fit = sampledFit(scene, mesh, f);
  const std::vector<float> solved = fit.solve(0.0);
  const NormalEquations equations = fit.equations(0.0);
  EXPECT_NEAR(throughRow(scene, mesh, equations.inverseRow(4), f), solved[4], 1e-5);
}

TEST(NormalEquations, InverseRow_IsCloseToTheSolutionOnALargeMesh) {
  const CompiledScene scene = test::ground(12, 1.0f);
  const FitMesh mesh = makeFitMesh(scene);
  // A step, such as a shadow's edge.
  const auto f = [](double x, double z) { return x + 0.3 * z > 0.1 ? 1.0 : 0.0; };
  const VertexFit fit = sampledFit(scene, mesh, f);
  const std::vector<float> solved = fit.solve(defaultSmoothing);
  const NormalEquations equations = fit.equations(defaultSmoothing);
  double squares = 0.0;
  for (std::uint32_t slot = 0; slot < mesh.slotCount(); ++slot) {
    const double difference = throughRow(scene, mesh, equations.inverseRow(slot), f) - solved[slot];
    squares += difference * difference;
  }
  EXPECT_LT(std::sqrt(squares / mesh.slotCount()), 0.01);
}

TEST(NormalEquations, SlotWithoutSamples_HasNoRow) {
  const CompiledScene scene = test::ground(2, 1.0f);
  const FitMesh mesh = makeFitMesh(scene);
  EXPECT_TRUE(VertexFit(mesh, 1).equations(defaultSmoothing).inverseRow(0).empty());
}

}  // namespace
}  // namespace prelight
