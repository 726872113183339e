#include "techniques/ambient_occlusion/occlusion_map.h"

#include <gtest/gtest.h>

#include <cmath>

#include "charts/light_map_lookup.h"
#include "charts/make_light_map_layout.h"
#include "prelight/error.h"
#include "support/devices.h"
#include "support/scenes.h"

namespace prelight {
namespace {

constexpr double wallHeight = 2.0, wallHalfWidth = 0.1;

/// A floor of two triangles, 10 x 40 m, and a wall along its middle.
CompiledScene floorByWall() {
  CompiledScene scene =
      test::sceneOf({{-5, 0, 20}, {5, 0, 20}, {5, 0, -20}, {-5, 0, -20}}, {{0, 1, 2}, {0, 2, 3}});
  test::append(scene, test::box(1, {-wallHalfWidth, 0, -20}, {wallHalfWidth, wallHeight, 20}, false));
  scene.primitives[0].name = "floor";
  scene.primitives[1].name = "wall";
  scene.primitives[1].node = 1;
  return scene;
}

LightMapLayout layoutOf(const CompiledScene& scene) {
  LightMapLayoutRequest request;
  request.texelSize = 0.1;
  return makeLightMapLayout(Scene{}, scene, request);
}

struct Made {
  LightMap map;
  OcclusionMapReport report;
};

Made make(const CompiledScene& scene, const OcclusionMapRequest& request) {
  Made made;
  Progress progress;
  made.map = makeOcclusionMap(scene, layoutOf(scene), request, test::sharedDevice(), progress, made.report);
  return made;
}

/// Value of a look-up at a place of the floor.
double shownAt(const CompiledScene& scene, const LightMap& map, double x, double z) {
  for (std::uint32_t t = 0; t < 2; ++t) {
    const glm::uvec3& c = scene.triangles[t];
    const auto at = [&](std::uint32_t v) { return glm::dvec2(scene.positions[v].x, scene.positions[v].z); };
    const glm::dvec2 e = at(c.y) - at(c.x), f = at(c.z) - at(c.x), p = glm::dvec2(x, z) - at(c.x);
    const double area = e.x * f.y - e.y * f.x, b1 = (p.x * f.y - p.y * f.x) / area,
                 b2 = (e.x * p.y - e.y * p.x) / area;
    if (b1 >= 0.0 && b2 >= 0.0 && b1 + b2 <= 1.0) return lightMapIrradiance(map, t, b1, b2).x;
  }
  return -1.0;
}

/// Accessibility at a distance from a long wall: half of 1 + cos of the angle that the wall hides.
double openAt(double distance) {
  return 1.0 - 0.5 * (1.0 - 1.0 / std::sqrt(1.0 + std::pow(wallHeight / distance, 2.0)));
}

TEST(OcclusionMap, FloorOfTwoTrianglesByAWall_IsTheClosedForm) {
  const CompiledScene scene = floorByWall();
  const Made made = make(scene, {});
  double squares = 0.0, count = 0.0;
  for (double distance = 0.1; distance < 4.6; distance += 0.15)
    for (double z = -10.0; z <= 10.0; z += 2.5) {
      const double off = shownAt(scene, made.map, wallHalfWidth + distance, z) - openAt(distance);
      EXPECT_NEAR(off, 0.0, 0.02) << distance << " " << z;
      squares += off * off;
      count += 1.0;
    }
  EXPECT_LT(std::sqrt(squares / count), 0.006);
  // The error includes the foot of the wall, where the map changes fastest.
  EXPECT_GT(made.report.error, 0.0);
  EXPECT_LT(made.report.error, 0.02);
  EXPECT_GE(made.report.places, 2000u);
}

TEST(OcclusionMap, Limits_AreKeptTo) {
  const CompiledScene scene = floorByWall();
  OcclusionMapRequest request;
  request.rays = 64;
  request.limits.farthest = 0.5;
  EXPECT_EQ(shownAt(scene, make(scene, request).map, 1.0, 3.0), 1.0);
  request.limits = {};
  request.limits.obscurance = 2.0;
  const double faded = shownAt(scene, make(scene, request).map, 0.6, 3.0);
  EXPECT_GT(faded, openAt(0.5) + 0.05);
  EXPECT_LT(faded, 0.99);
}

TEST(OcclusionMap, ShadowSets_AreKeptTo) {
  const CompiledScene scene = floorByWall();
  OcclusionMapRequest request;
  request.rays = 64;
  request.shadowSets = {{{"floor"}, {"floor"}}};
  EXPECT_EQ(shownAt(scene, make(scene, request).map, 0.6, 3.0), 1.0);
  request.shadowSets = {{{"ceiling"}, {}}};
  EXPECT_THROW(make(scene, request), UsageError);
}

TEST(OcclusionMap, Error_IsThatOfWhatIsShown) {
  const CompiledScene scene = floorByWall();
  LightMapLayoutRequest coarse;
  coarse.texelSize = 1.0;
  Progress progress;
  OcclusionMapReport report;
  const LightMap map = makeOcclusionMap(scene, makeLightMapLayout(Scene{}, scene, coarse), {},
                                        test::sharedDevice(), progress, report);
  double squares = 0.0, count = 0.0;
  for (double distance = 0.05; distance < 4.9; distance += 0.1) {
    const double off = shownAt(scene, map, wallHalfWidth + distance, 0.37) - openAt(distance);
    squares += off * off;
    count += 1.0;
  }
  // The floor is half of the surface; the texels of the walls have errors of similar size.
  EXPECT_NEAR(report.error, std::sqrt(squares / count), 0.5 * std::sqrt(squares / count));
}

}  // namespace
}  // namespace prelight
