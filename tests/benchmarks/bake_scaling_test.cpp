#include <gmock/gmock.h>

#include <cmath>

#include "benchmarks/run/measure.h"
#include "benchmarks/scenes/detailed_scene.h"
#include "benchmarks/suites/bake/scaling.h"
#include "benchmarks/suites/bake/scaling_peers.h"
#include "scene/gltf/load/loader.h"
#include "support/run_bake.h"

namespace prelight::benchmarks {
namespace {

using ::testing::ElementsAre;

CompiledScene compiledBalls(std::uint64_t triangles) {
  Warnings warnings;
  const CompiledScene scene = compileScene(loadScene(makeBumpyBalls(triangles), warnings), warnings);
  EXPECT_THAT(warnings, ElementsAre());
  return scene;
}

BakeOptions optionsOf(std::uint64_t mostRays, const std::string& onlyCase) {
  auto options = optionsIn<BakeOptions>({});
  options.scalingRays = {16, 64, 256};
  options.scalingMostRays = mostRays;
  options.onlyCase = onlyCase;
  return options;
}

std::vector<std::string> namesOf(const std::vector<ScalingCase>& cases) {
  std::vector<std::string> names;
  for (const ScalingCase& some : cases) names.push_back(some.name());
  return names;
}

TEST(BumpyBalls, OfAnySize_HaveAboutTheTrianglesThatWereAskedFor) {
  for (const std::uint64_t count : {2000u, 10000u, 100000u, 407000u}) {
    const CompiledScene scene = compiledBalls(count);
    EXPECT_NEAR(static_cast<double>(scene.triangleCount()) / static_cast<double>(count), 1.0, 0.02) << count;
    EXPECT_EQ(scene.droppedTriangles, 0u);
  }
}

TEST(BumpyBalls, MadeTwice_AreTheSame) {
  EXPECT_EQ(compiledBalls(3000).positions, compiledBalls(3000).positions);
}

TEST(BumpyBalls, AllOfThem_LieAboveTheFloor) {
  const CompiledScene scene = compiledBalls(5000);
  for (const PrimitiveRange& range : scene.primitives)
    for (std::uint32_t v = range.firstVertex; v < range.firstVertex + range.vertexCount; ++v) {
      const double y = scene.origin.y + double(scene.positions[v].y);
      if (range.name == "Floor")
        EXPECT_NEAR(y, 0.0, 1e-6);
      else
        EXPECT_GT(y, 0.005) << range.name;
    }
}

TEST(BumpyBalls, AllOfThem_FaceOutwards) {
  const CompiledScene scene = compiledBalls(100000);
  for (const PrimitiveRange& range : scene.primitives) {
    if (range.name == "Floor") continue;
    glm::dvec3 centre(0.0);
    for (std::uint32_t v = 0; v < range.vertexCount; ++v)
      centre += glm::dvec3(scene.positions[range.firstVertex + v]) / double(range.vertexCount);
    for (std::uint32_t t = range.firstTriangle; t < range.firstTriangle + range.triangleCount; ++t) {
      const glm::dvec3 corner(scene.positions[scene.triangles[t].x]);
      ASSERT_GT(glm::dot(geometricNormal(scene, t), corner - centre), 0.0) << t;
    }
  }
}

TEST(ScalingCases, OfALargeScene_LeaveOutLongBakes) {
  EXPECT_THAT(
      namesOf(scalingCases("balls 1M", 1000000, optionsOf(20000000, ""))),
      ElementsAre("balls 1M/--ao/16 rays", "balls 1M/--ao/64 rays",
                  "balls 1M/--ao --sh 3 --bounces 1/16 rays", "balls 1M/--ao --sh 3 --bounces 1/64 rays"));
}

TEST(ScalingCases, WithAFilter_AreThoseThatContainItOrTheOneThatItNames) {
  EXPECT_THAT(namesOf(scalingCases("balls 1M", 1000000, optionsOf(20000000, "--ao/"))),
              ElementsAre("balls 1M/--ao/16 rays", "balls 1M/--ao/64 rays"));
  EXPECT_THAT(namesOf(scalingCases("balls 1M", 1000000, optionsOf(20000000, "balls 1M/--ao/256 rays"))),
              ElementsAre("balls 1M/--ao/256 rays"));
  EXPECT_TRUE(scalingCases("balls 1M", 1000000, optionsOf(20000000, "balls 2M")).empty());
}

TEST(ScalingCases, Options_SayWhatTheRequestAsksFor) {
  const std::vector<ScalingCase> cases = scalingCases("balls 1M", 1000, optionsOf(20000000, "--sh 3"));
  ASSERT_FALSE(cases.empty());
  EXPECT_THAT(cases.front().options(), ElementsAre("--ao", "--sh", "3", "--bounces", "1", "--rays", "16"));
  EXPECT_EQ(cases.front().request.sh.order, 3);
  EXPECT_EQ(cases.front().request.bounces, 1);
  EXPECT_EQ(cases.front().request.effort.rays, 16u);
}

TEST(PowerOf, PointsOfAPowerLaw_IsItsExponent) {
  const std::vector<Point> points = {{1e4, 3.0 * 1e6}, {1e5, 3.0 * std::pow(1e5, 1.5)}, {1e6, 3.0 * 1e9}};
  EXPECT_NEAR(powerOf(points), 1.5, 1e-12);
}

TEST(BakeSeconds, OfAReport_AreThoseFromPrepareToWrite) {
  const auto report = nlohmann::ordered_json::parse(
      R"({"stages": {"load": 10, "compile": 20, "plan": 30, "device": 40, "prepare": 1, "cast": 2, "write": 3},
          "processorSeconds": {"bake": 4, "write": 5}})");
  EXPECT_DOUBLE_EQ(bakeSeconds(report), 6.0);
  EXPECT_DOUBLE_EQ(bakeProcessorSeconds(report), 9.0);
}

TEST(RaysAlone, OfABake_AreAsManyAsItCasts) {
  const CompiledScene scene = compiledBalls(3000);
  Tracer tracer(scene, test::sharedDevice());
  for (const int bounces : {0, 1}) {
    BakeRequest request = aoRequest(16, 7);
    request.sh.order = bounces;
    request.bounces = bounces;
    const TracingCost cost = traceRaysAlone(scene, request, tracer, ~0ull, 1, Progress());
    EXPECT_EQ(cost.rays, test::runBake(scene, request).report.rays);
    EXPECT_GT(cost.seconds, 0.0);
  }
}

TEST(RaysAlone, OfWhichFewAreEnough_AreAWholePass) {
  const CompiledScene scene = compiledBalls(3000);
  Tracer tracer(scene, test::sharedDevice());
  const BakeRequest request = aoRequest(64, 7);
  const std::uint64_t all = traceRaysAlone(scene, request, tracer, ~0ull, 1, Progress()).rays;
  const std::uint64_t pass = traceRaysAlone(scene, request, tracer, 1, 2, Progress()).rays;
  EXPECT_NEAR(static_cast<double>(pass) / static_cast<double>(all), 1.0 / 8.0, 0.01);
}

}  // namespace
}  // namespace prelight::benchmarks
