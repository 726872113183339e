#include "viewer/light_option.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "prelight/error.h"

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

TEST(LightOption, Spot_TakesDegrees) {
  const Light light = parseLight("spot:0,3,0:0,-1,0:20,30:50,50,50");
  EXPECT_EQ(light.type, LightType::Spot);
  EXPECT_NEAR(light.innerConeAngle, 0.349066f, 1e-5f);
  EXPECT_NEAR(light.outerConeAngle, 0.523599f, 1e-5f);
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
                           "point:0,1e16,0:1,1,1"}) {
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
