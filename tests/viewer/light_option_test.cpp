#include "viewer/options/light_option.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "prelight/error.h"
#include "scene/light_shape.h"

namespace prelight::viewer {
namespace {

TEST(LightOption, Point_IsRead) {
  const Light light = parseLight("point:1,-2.5,3e1:10,20,0");
  EXPECT_EQ(light.type, LightType::Point);
  EXPECT_EQ(light.position, glm::dvec3(1, -2.5, 30));
  EXPECT_EQ(light.intensity, glm::vec3(10, 20, 0));
  EXPECT_EQ(light.range, 0.0f);
}

TEST(LightOption, Directional_IsNormalised) {
  const Light light = parseLight("directional:0,-2,0:3,3,3");
  EXPECT_EQ(light.type, LightType::Directional);
  EXPECT_EQ(light.direction, glm::dvec3(0, -1, 0));
}

TEST(LightOption, Sizes_AreReadBehindPunctualLights) {
  EXPECT_NEAR(parseLight("directional:0,-2,0:3,3,3:angle=40").radius, 0.349066f, 1e-5f);
  EXPECT_EQ(parseLight("point:1,2,3:1,1,1:radius=0.25").radius, 0.25f);
  EXPECT_EQ(parseLight("spot:0,3,0:0,-1,0:20,30:50,50,50:radius=2").radius, 2.0f);
  for (const char* text : {"directional:0,-2,0:3,3,3:angle=181", "directional:0,-2,0:3,3,3:angle=-1",
                           "point:1,2,3:1,1,1:radius=0", "point:1,2,3:1,1,1:angle=3"})
    EXPECT_THROW(parseLight(text), UsageError) << text;
}

TEST(LightOption, Spot_TakesDegrees) {
  const Light light = parseLight("spot:0,3,0:0,-1,0:20,30:50,50,50");
  EXPECT_EQ(light.type, LightType::Spot);
  EXPECT_NEAR(light.innerConeAngle, 0.349066f, 1e-5f);
  EXPECT_NEAR(light.outerConeAngle, 0.523599f, 1e-5f);
}

TEST(LightOption, Area_IsRadianceOfAShape) {
  const Light ball = parseLight("area:sphere:1,2,3:0.5:10,20,0");
  EXPECT_EQ(ball.type, LightType::Area);
  EXPECT_EQ(ball.position, glm::dvec3(1, 2, 3));
  EXPECT_EQ(ball.shape->kind, ShapeKind::Sphere);
  EXPECT_EQ(ball.shape->radius, 0.5);
  EXPECT_EQ(ball.intensity, glm::vec3(10, 20, 0));
  const Light disk = parseLight("area:disk:1,2,3:0,-2,0:0.5:10,20,0:two-sided");
  EXPECT_EQ(disk.direction, glm::dvec3(0, -1, 0));
  EXPECT_TRUE(disk.shape->twoSided);
}

TEST(LightOption, Quad_LiesLevelUntilItIsTurned) {
  const Light quad = parseLight("area:quad:0,1,0:1,0,0:2,1:1,1,1");
  EXPECT_NEAR(std::abs(quad.side.z), 1.0, 1e-12);
  EXPECT_EQ(quad.shape->corners.size(), 4u);
  EXPECT_NEAR(shapeArea(*quad.shape), 2.0, 1e-12);
  EXPECT_NEAR(std::abs(parseLight("area:quad:0,1,0:1,0,0:2,1:1,1,1:turn=90").side.y), 1.0, 1e-12);
}

TEST(LightOption, Polygon_ShinesToWhereItIsCounterClockwise) {
  const Light light = parseLight("area:polygon:0,2,0:2,2,0:0,2,2:6,6,6");
  EXPECT_NEAR(light.direction.y, -1.0, 1e-12);
  EXPECT_NEAR(shapeArea(*light.shape), 2.0, 1e-12);
  const std::vector<glm::dvec3> corners = cornersOf(light);
  EXPECT_NEAR(glm::length(corners[1] - glm::dvec3(2, 2, 0)), 0.0, 1e-12);
}

TEST(LightOption, ExitanceAndPower_AreRadianceOverPiAndOverPiArea) {
  const auto pi = std::numbers::pi_v<float>;
  EXPECT_NEAR(parseLight("area:sphere:0,0,0:2:3,0,0:exitance").intensity.x, 3.0f / pi, 1e-6f);
  EXPECT_NEAR(parseLight("area:sphere:0,0,0:2:3,0,0:power").intensity.x, 3.0f / (pi * 16.0f * pi), 1e-6f);
  EXPECT_NEAR(parseLight("area:quad:0,0,0:0,1,0:2,3:6,0,0:power").intensity.x, 1.0f / pi, 1e-6f);
  EXPECT_NEAR(parseLight("area:quad:0,0,0:0,1,0:2,3:6,0,0:power:two-sided").intensity.x, 0.5f / pi, 1e-6f);
}

TEST(LightOption, BadSyntax_IsAUsageErrorWithAnExample) {
  for (const char* text : {"",
                           "point",
                           "lamp:0,0,0:1,1,1",
                           "point:0,0:1,1,1",
                           "point:0,0,0",
                           "point:0,0,0:1,1,1:2",
                           "point:0,0,x:1,1,1",
                           "point:0,0,0:1,1,",
                           "point:0,0,0:1,1,1 ",
                           "point:nan,0,0:1,1,1",
                           "point:inf,0,0:1,1,1",
                           "point:0,0,0:1,1,-1",
                           "point:1e999,0,0:1,1,1",
                           "directional:0,0,0:1,1,1",
                           "spot:0,0,0:0,-1,0:30,20:1,1,1",
                           "spot:0,0,0:0,-1,0:20,91:1,1,1",
                           "spot:0,0,0:0,-1,0:-1,20:1,1,1",
                           "spot:0,0,0:0,-1,0:1,1,1",
                           "Point:0,0,0:1,1,1",
                           "point:0,0,0:1,1e16,1",
                           "point:0,1e16,0:1,1,1",
                           "point:0,0,0:1,1,1:aim=0,-1,0",
                           "point:0,0,0:1,1,1:turn=3",
                           "spot:0,0,0:0,-1,0:10,20:1,1,1:turn=3",
                           "spot:0,0,0:0,-1,0:10,85:1,1,1:cookie=a.png",
                           "area",
                           "area:ball:0,0,0:1:1,1,1",
                           "area:sphere:0,0,0:0:1,1,1",
                           "area:sphere:0,0,0:1:1,1,1:two-sided",
                           "area:sphere:0,0,0:1:1,1,1:power:exitance",
                           "area:disk:0,0,0:0,0,0:1:1,1,1",
                           "area:quad:0,0,0:0,1,0:1:1,1,1",
                           "area:quad:0,0,0:0,1,0:1,-1:1,1,1",
                           "area:quad:0,0,0:0,1,0:1,1:1,1,1:turn=x",
                           "area:polygon:0,0,0:1,0,0:1,1,1",
                           "area:polygon:0,0,0:1,0,0:2,0,0:1,1,1",
                           "area:polygon:0,0,0:1,0,0:1,1,0:0,1,0.5:1,1,1",
                           "area:polygon:0,0,0:2,0,0:0.5,0.5,0:0,2,0:1,1,1"}) {
    try {
      parseLight(text);
      ADD_FAILURE() << "accepted '" << text << "'";
    } catch (const UsageError& error) {
      EXPECT_EQ(error.code(), ExitCode::BadUsage);
      EXPECT_THAT(error.what(), testing::HasSubstr("for example point:0,2,0:10,10,10")) << text;
    }
  }
}

}  // namespace
}  // namespace prelight::viewer
