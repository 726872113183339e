// Messages of drivers about shaders, with the names of their files.
#include "viewer/gl/shader_log.h"

#include <gtest/gtest.h>

namespace prelight::viewer::gl {
namespace {

const std::vector<std::string> files = {"surface.frag", "lights.glsl"};

TEST(ShaderLog, NumbersOfFiles_BecomeTheirNames) {
  EXPECT_EQ(nameShaderFiles("1:23(7): error: x undeclared\n", files),
            "\n  lights.glsl:23(7): error: x undeclared");
  EXPECT_EQ(nameShaderFiles("ERROR: 0:4: 'x' : undeclared", files), "\n  surface.frag:4: 'x' : undeclared");
  EXPECT_EQ(nameShaderFiles("1(8) : error C1008: x", files), "\n  lights.glsl:8 : error C1008: x");
}

TEST(ShaderLog, OtherLines_StayAsTheyAre) {
  for (const char* line :
       {"2:1: no such file", "2 errors generated.", "1:x", "(1:2)", "ERROR: linking failed"})
    EXPECT_EQ(nameShaderFiles(line, files), std::string("\n  ") + line);
}

}  // namespace
}  // namespace prelight::viewer::gl
