#include "base/module.h"

#include <gtest/gtest.h>

#include <string>

#include "prelight/error.h"

namespace prelight {
namespace {

TEST(Module, ProgramBesideTheModules_IsFoundAsTheyAre) {
  const std::filesystem::path program = findProgramBesideModules("prelight-compiler");
  ASSERT_FALSE(program.empty());
  void* const png = moduleFunction("libprelight_png.so", "prelightDecodePlainPng");
  EXPECT_EQ(program.parent_path(), std::filesystem::path(fileOfFunction(png)).parent_path());
}

TEST(Module, ProgramThatIsNotThere_IsEmpty) {
  EXPECT_EQ(findProgramBesideModules("prelight-no-such-program"), std::filesystem::path());
}

TEST(Module, ModuleThatIsNotThere_IsAnErrorWithItsName) {
  try {
    moduleFunction("libprelight_no_such_module.so", "any");
    FAIL() << "found";
  } catch (const Error& error) {
    EXPECT_EQ(error.where(), "libprelight_no_such_module.so");
  }
}

}  // namespace
}  // namespace prelight
