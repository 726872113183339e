// Inside a closed mesh every ray must hit, wherever it goes: the number of leaks must be 0.
#include <gtest/gtest.h>

#include <algorithm>
#include <glm/gtc/matrix_transform.hpp>

#include "base/parallel.h"
#include "gpu/tracer.h"
#include "stress/closed_meshes.h"
#include "stress/rays.h"
#include "support/devices.h"
#include "support/scenes.h"

namespace prelight {
namespace {

constexpr std::uint64_t raysOfASuite = 1'600'000;  // For each of the two suites and for each tree.
constexpr std::size_t blockSize = std::size_t{1} << 20;

class WatertightTest : public ::testing::TestWithParam<BvhLayout> {
 protected:
  // Number of rays that find no closest hit, or no any hit.
  static std::uint64_t leaksOf(const test::ClosedMesh& mesh, std::uint64_t count) {
    Tracer tracer(mesh.scene, test::sharedDevice(), GetParam());
    std::uint64_t leaks = 0;
    std::vector<device::Ray> rays;
    for (std::uint64_t first = 0; first < count; first += blockSize) {
      rays.resize(std::min<std::uint64_t>(blockSize, count - first));
      parallelRanges(rays.size(), 4096, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) rays[i] = test::aimedRay(mesh, first + i, 7);
      });
      const auto closest = tracer.traceClosest(rays);
      const auto any = tracer.traceAny(rays);
      for (std::size_t i = 0; i < rays.size(); ++i) {
        if (closest[i].triangle != PRELIGHT_NO_TRIANGLE && any[i].triangle != PRELIGHT_NO_TRIANGLE) continue;
        if (leaks++ == 0)
          ADD_FAILURE() << mesh.name << ": ray " << first + i << " leaks, closest "
                        << (closest[i].triangle != PRELIGHT_NO_TRIANGLE) << ", any "
                        << (any[i].triangle != PRELIGHT_NO_TRIANGLE);
      }
    }
    return leaks;
  }

  static void expectNoLeaks(const std::vector<test::ClosedMesh>& meshes, std::uint64_t rays) {
    ASSERT_FALSE(meshes.empty());
    const std::uint64_t share = (rays + meshes.size() - 1) / meshes.size();
    std::uint64_t leaks = 0;
    for (const auto& mesh : meshes) {
      const std::uint64_t found = leaksOf(mesh, share);
      EXPECT_EQ(found, 0u) << mesh.name << ", of " << share << " rays";
      leaks += found;
    }
    RecordProperty("rays", std::to_string(share * meshes.size()));
    RecordProperty("leaks", std::to_string(leaks));
  }
};

TEST_P(WatertightTest, ClosedMeshes_RaysAtEdgesAndVertices_NeverLeak) {
  std::vector<test::ClosedMesh> meshes = test::closedObjectsOfBuiltinScenes();
  EXPECT_GE(meshes.size(), 5u);
  const CompiledScene ball = test::sphere(32, 1.0f, {0.25f, -0.5f, 0.125f});
  meshes.push_back(test::closedMesh("sphere", ball));
  meshes.push_back(test::closedMesh("torus", test::torus(96, 48, 1.0f, 0.4f)));
  meshes.push_back(test::closedMesh("room", test::box(16, {-2, 0, -3}, {2, 2.5f, 3}, true)));
  meshes.push_back(test::closedMesh("fine torus", test::torus(512, 256, 1.0f, 0.4f), 32));
  meshes.push_back(test::closedMesh("slivers 1e-3", test::withSlivers(ball, 1e-3f)));
  meshes.push_back(test::closedMesh("slivers 1e-6", test::withSlivers(ball, 1e-6f)));
  meshes.push_back(test::closedMesh("slivers 1e-8", test::withSlivers(ball, 1e-8f)));
  meshes.push_back(test::closedMesh("needles", test::needles(600, 1e4f)));
  meshes.push_back(test::closedMesh("disc", test::moved(ball, {1.0f, 1e-6f, 1.0f}, glm::vec3(0))));
  expectNoLeaks(meshes, test::stressRays(raysOfASuite));
}

// Vertices are rounded at their final place, shared ones identically: a mesh stays closed however coarse it
// becomes.
TEST_P(WatertightTest, ClosedMeshes_ScaledAndFarFromZero_NeverLeak) {
  std::vector<test::ClosedMesh> meshes;
  const CompiledScene ball = test::sphere(32, 1.0f, {0.25f, -0.5f, 0.125f});
  const CompiledScene ring = test::torus(96, 48, 1.0f, 0.4f);
  for (const float scale : {1e-6f, 1e6f})
    for (const auto* mesh : {&ball, &ring})
      meshes.push_back(test::closedMesh("scaled", test::moved(*mesh, glm::vec3(scale), glm::vec3(0))));
  for (const float offset : {1e3f, 1e4f, 1e5f, 1e6f})
    for (const auto* mesh : {&ball, &ring})
      meshes.push_back(
          test::closedMesh("translated by " + std::to_string(offset),
                           test::moved(*mesh, glm::vec3(10), glm::vec3(offset, -offset, offset))));
  expectNoLeaks(meshes, test::stressRays(raysOfASuite));
}

/// Closed objects of the built-in scenes, which were loaded at several scales and places.
std::vector<test::ClosedMesh> loadedObjects() {
  std::vector<test::ClosedMesh> meshes;
  for (const double scale : {1e-6, 1.0, 1e6})
    for (const double offset : {0.0, 1e6}) {
      const auto transform = glm::scale(
          glm::translate(glm::dmat4(1.0), glm::dvec3(offset, -offset, 2 * offset)), glm::dvec3(scale));
      // At a scale of 1e-6 and a distance of 1e6, doubles keep four digits of the object, which is enough to
      // stay closed.
      for (auto& mesh : test::closedObjectsOfBuiltinScenes(transform)) meshes.push_back(std::move(mesh));
    }
  return meshes;
}

// compileScene moves a scene to its centre before it rounds to float.
TEST_P(WatertightTest, LoadedObjects_ScaledAndFarFromZero_NeverLeak) {
  static const std::vector<test::ClosedMesh> meshes = loadedObjects();  // for both layouts
  EXPECT_GE(meshes.size(), 30u);
  expectNoLeaks(meshes, test::stressRays(raysOfASuite));
}

INSTANTIATE_TEST_SUITE_P(Layouts, WatertightTest, ::testing::Values(BvhLayout::Wide, BvhLayout::Narrow),
                         [](const auto& test) { return test.param == BvhLayout::Wide ? "Wide" : "Narrow"; });

}  // namespace
}  // namespace prelight
