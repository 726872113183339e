#include "fit/vertex_fit.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "receivers/fit_mesh.h"
#include "receivers/sampling.h"
#include "support/scenes.h"

namespace prelight {
namespace {

/// Adds samples of `f`, spread evenly over every triangle.
template <typename F>
void addSamples(const CompiledScene& scene, VertexFit& fit, std::uint32_t perTriangle, F f) {
  for (std::uint32_t t = 0; t < scene.triangleCount(); ++t)
    for (std::uint32_t i = 0; i < perTriangle; ++i) {
      const glm::dvec2 b = sampling::uniformTriangle(sampling::sobol(i, t));
      const auto& c = scene.triangles[t];
      const glm::vec3 p = float(1 - b.x - b.y) * scene.positions[c.x] + float(b.x) * scene.positions[c.y] +
                          float(b.y) * scene.positions[c.z];
      const double value = f(p);
      fit.add({t, float(b.x), float(b.y), float(0.5 * glm::length(geometricNormal(scene, t)) / perTriangle)},
              std::span(&value, 1));
    }
}

TEST(FitMesh, VerticesOfSamePlaceAndNormal_ShareASlot) {
  CompiledScene scene = test::sceneOf({{0, 0, 0}, {1, 0, 0}, {0, 0, -1}, {1, 0, 0}, {1, 0, -1}, {0, 0, -1}},
                                      {{0, 1, 2}, {3, 4, 5}});
  const FitMesh mesh = makeFitMesh(scene);
  EXPECT_EQ(mesh.slotCount(), 4u);
  EXPECT_EQ(mesh.slotOfVertex[1], mesh.slotOfVertex[3]);
  EXPECT_EQ(mesh.slotOfVertex[2], mesh.slotOfVertex[5]);
  scene.normals[3] = {1, 0, 0};
  EXPECT_EQ(makeFitMesh(scene).slotCount(), 5u) << "a crease must stay split";
}

TEST(VertexFit, LinearFunctionWithoutSmoothing_IsReproduced) {
  const CompiledScene scene = test::ground(6, 1.0f);
  const FitMesh mesh = makeFitMesh(scene);
  VertexFit fit(mesh, 1);
  const auto f = [](const glm::vec3& p) { return 0.3 + 2.0 * p.x - 0.7 * p.z; };
  addSamples(scene, fit, 5, f);
  const auto x = fit.solve(0.0);
  for (std::uint32_t s = 0; s < mesh.slotCount(); ++s)
    EXPECT_NEAR(x[s], f(scene.positions[mesh.vertexOfSlot[s]]), 1e-5);
}

TEST(VertexFit, ConstantWithSmoothing_IsReproduced) {
  const CompiledScene scene = test::sphere(8, 1.0f, {});
  const FitMesh mesh = makeFitMesh(scene);
  VertexFit fit(mesh, 1);
  addSamples(scene, fit, 3, [](const glm::vec3&) { return -0.4; });
  for (const double x : fit.solve(0.3)) EXPECT_NEAR(x, -0.4, 1e-6);
}

TEST(VertexFit, TriangleWithoutSamples_FollowsItsNeighbours) {
  const CompiledScene scene = test::ground(4, 1.0f);
  const FitMesh mesh = makeFitMesh(scene);
  VertexFit fit(mesh, 1);
  const double value = 2.0;
  for (std::uint32_t t = 2; t < scene.triangleCount(); ++t)
    fit.add({t, 0.3f, 0.3f, 1.0f}, std::span(&value, 1));
  for (const double x : fit.solve(defaultSmoothing)) EXPECT_NEAR(x, 2.0, 1e-3);
}

TEST(VertexFit, VertexOfNoTriangle_StaysZero) {
  CompiledScene scene = test::sceneOf({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {5, 5, 5}}, {{0, 1, 2}});
  const FitMesh mesh = makeFitMesh(scene);
  VertexFit fit(mesh, 1);
  addSamples(scene, fit, 8, [](const glm::vec3&) { return 1.0; });
  EXPECT_EQ(fit.solve(defaultSmoothing)[mesh.slotOfVertex[3]], 0.0);
}

// Beside a step, values at vertices must not be pulled to the value that the vertex itself would see.
TEST(VertexFit, QuadraticFunction_HasLeastSurfaceError) {
  const CompiledScene scene = test::ground(4, 1.0f);
  const FitMesh mesh = makeFitMesh(scene);
  VertexFit fit(mesh, 1);
  const auto f = [](const glm::vec3& p) { return double(p.x) * p.x; };
  addSamples(scene, fit, 64, f);
  const auto x = fit.solve(0.0);
  const auto surfaceError = [&](const auto& values) {
    double sum = 0.0;
    for (std::uint32_t t = 0; t < scene.triangleCount(); ++t)
      for (std::uint32_t i = 0; i < 64; ++i) {
        const glm::dvec2 b = sampling::uniformTriangle(sampling::sobol(i, t + 999));
        const auto& c = scene.triangles[t];
        const glm::vec3 p = float(1 - b.x - b.y) * scene.positions[c.x] + float(b.x) * scene.positions[c.y] +
                            float(b.y) * scene.positions[c.z];
        const double e = (1 - b.x - b.y) * values[mesh.triangles[t][0]] + b.x * values[mesh.triangles[t][1]] +
                         b.y * values[mesh.triangles[t][2]] - f(p);
        sum += e * e;
      }
    return sum;
  };
  std::vector<double> atVertices(mesh.slotCount());
  for (std::uint32_t s = 0; s < mesh.slotCount(); ++s)
    atVertices[s] = f(scene.positions[mesh.vertexOfSlot[s]]);
  EXPECT_LT(surfaceError(x), 0.4 * surfaceError(atVertices));
}

// Sums are parked in the file, saved from there, and brought back to memory with another sample.
TEST(VertexFit, ParkedSums_SolveToTheSameBits) {
  const CompiledScene scene = test::ground(8, 1.0f);
  const FitMesh mesh = makeFitMesh(scene);
  VertexFit fit(mesh, 2);
  for (std::uint32_t t = 0; t < scene.triangleCount(); ++t)
    fit.add({t, 0.2f, 0.5f, 1.0f}, std::array{1.0 * t, 3.0});
  VertexFit parked = fit;
  parked.park();
  EXPECT_EQ(parked.solve(defaultSmoothing), fit.solve(defaultSmoothing));
  EXPECT_EQ(parked.solveColumn(defaultSmoothing, 1), fit.solveColumn(defaultSmoothing, 1));
  StateWriter ofParked, ofFit;
  parked.save(ofParked);
  fit.save(ofFit);
  EXPECT_TRUE(std::ranges::equal(ofParked.payload(), ofFit.payload()));
  parked.fetch();
  for (VertexFit* each : {&parked, &fit}) each->add({3, 0.1f, 0.1f, 1.0f}, std::array{7.0, 5.0});
  EXPECT_EQ(parked.solve(defaultSmoothing), fit.solve(defaultSmoothing));
}

}  // namespace
}  // namespace prelight
